#include "observation/silhouette/planes.h"

#include <gtest/gtest.h>

namespace walktrack {
namespace {

LogRatioPlanes one_row(const std::vector<float>& values, double clip) {
  LogRatioPlanes planes;
  resize(planes, {10, 20, 10 + static_cast<int>(values.size()), 21}, 1);
  set_row(planes, 0, 20, values, clip);
  return planes;
}

TEST(LogRatioPlanes, GiveBackWhatWasPutIn) {
  const std::vector<float> values{0.5F, -1.25F, 3, 0, -0.001F};
  const LogRatioPlanes planes = one_row(values, 4);
  for (size_t i = 0; i < values.size(); ++i) {
    // Half a fixed-point unit.
    EXPECT_NEAR(log_ratio_at(planes, Appearance::kLegs, 10 + static_cast<int>(i), 20),
                static_cast<double>(values[i]), 0.5 / LogRatioPlanes::kNat);
  }
}

TEST(LogRatioPlanes, ClipBothWays) {
  const LogRatioPlanes planes = one_row({100, -100, 2}, 2.5);
  EXPECT_EQ(log_ratio_at(planes, Appearance::kTrunk, 10, 20), 2.5);
  EXPECT_EQ(log_ratio_at(planes, Appearance::kTrunk, 11, 20), -2.5);
  EXPECT_EQ(log_ratio_at(planes, Appearance::kTrunk, 12, 20), 2);
}

TEST(LogRatioPlanes, AreSilentOutsideTheirArea) {
  const LogRatioPlanes planes = one_row({1, 1}, 4);
  for (const auto& [x, y] : {std::pair{9, 20}, {12, 20}, {10, 19}, {10, 21}})
    EXPECT_EQ(log_ratio_at(planes, Appearance::kHead, x, y), 0) << x << ", " << y;
  EXPECT_EQ(log_ratio_at(LogRatioPlanes{}, Appearance::kHead, 0, 0), 0);
}

TEST(LogRatioPlanes, KeepTheirMemory) {
  LogRatioPlanes planes;
  resize(planes, {0, 0, 50, 40}, 3);
  const int32_t* const before = planes.prefix.data();
  resize(planes, {5, 5, 40, 30}, 2);
  resize(planes, {0, 0, 50, 40}, 3);
  EXPECT_EQ(planes.prefix.data(), before);
  EXPECT_EQ(planes.row(2, 39).size(), 51U);
}

TEST(PixelRect, Intersections) {
  const PixelRect both = intersection({0, 0, 10, 10}, {5, -5, 20, 8});
  EXPECT_EQ(both.width(), 5);
  EXPECT_EQ(both.height(), 8);
  EXPECT_FALSE(both.empty());
  EXPECT_TRUE(intersection({0, 0, 10, 10}, {10, 0, 20, 10}).empty());
  EXPECT_EQ(intersection({0, 0, 10, 10}, {30, 30, 40, 40}).width(), 0);
}

}  // namespace
}  // namespace walktrack
