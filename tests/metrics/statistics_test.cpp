#include "metrics/statistics/statistics.h"

#include <gtest/gtest.h>

namespace walktrack {
namespace {

TEST(ErrorStatistics, OfNothingIsZero) {
  EXPECT_EQ(error_statistics({}).count, 0u);
  EXPECT_EQ(error_statistics({}).mean, 0);
}

TEST(ErrorStatistics, OfAFewNumbersByHand) {
  const ErrorStatistics s = error_statistics({4, 1, 3, 2});
  EXPECT_EQ(s.count, 4u);
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.p95, 3.85);  // rank 0.95 * 3 = 2.85
  EXPECT_DOUBLE_EQ(s.rms * s.rms, 7.5);
  EXPECT_DOUBLE_EQ(s.worst, 4);
}

TEST(Quantile, ReachesBothEndsAndTakesASingleValue) {
  EXPECT_DOUBLE_EQ(quantile({3, 1, 2}, 0), 1);
  EXPECT_DOUBLE_EQ(quantile({3, 1, 2}, 1), 3);
  EXPECT_DOUBLE_EQ(quantile({7}, 0.3), 7);
}

}  // namespace
}  // namespace walktrack
