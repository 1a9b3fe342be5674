#include "filter/resampling.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/log_weights.h"
#include "core/rng.h"

namespace walktrack {
namespace {

constexpr double kNoWeight = -std::numeric_limits<double>::infinity();

std::vector<uint32_t> resampled(const std::vector<double>& log_weights, double u, size_t n) {
  std::vector<uint32_t> parents(n, 99);
  systematic_resample(log_weights, u, parents);
  return parents;
}

TEST(SystematicResample, Table) {
  EXPECT_EQ(resampled({0, 0, 0}, 0.5, 3), (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(resampled({kNoWeight, 0, kNoWeight}, 0.999, 4), (std::vector<uint32_t>{1, 1, 1, 1}));
  EXPECT_EQ(resampled({5}, 0.1, 2), (std::vector<uint32_t>{0, 0}));
  EXPECT_EQ(resampled({0, std::log(3.0)}, 0.5, 4), (std::vector<uint32_t>{0, 1, 1, 1}));
  EXPECT_EQ(resampled({0, 1e6}, 0.5, 2), (std::vector<uint32_t>{1, 1}));
}

TEST(SystematicResample, AllDeadLeavesTheParentsAlone) {
  std::vector<uint32_t> parents{7, 8};
  EXPECT_FALSE(systematic_resample(std::vector<double>{kNoWeight, kNoWeight}, 0.5, parents));
  EXPECT_EQ(parents, (std::vector<uint32_t>{7, 8}));
}

TEST(SystematicResample, NeverMoreThanOneAwayFromTheExpectedCountAndUnbiased) {
  Rng rng(1, Purpose::kTest);
  std::vector<double> w(50);
  for (double& x : w) x = 2 * rng.normal();
  const std::vector<double> p = normalised_weights(w);
  constexpr int kRounds = 4000;
  constexpr size_t kCount = 100;
  std::vector<double> mean(w.size(), 0);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<int> count(w.size(), 0);
    for (const uint32_t parent : resampled(w, rng.uniform(), kCount)) ++count[parent];
    for (size_t i = 0; i < w.size(); ++i) {
      ASSERT_LT(std::abs(count[i] - p[i] * kCount), 1.0);
      mean[i] += double(count[i]) / kRounds;
    }
  }
  // A count is one of two neighbours, so its variance is at most 1/4; 5 standard errors.
  for (size_t i = 0; i < w.size(); ++i)
    EXPECT_NEAR(mean[i], p[i] * kCount, 5 * 0.5 / std::sqrt(double{kRounds}));
}

}  // namespace
}  // namespace walktrack
