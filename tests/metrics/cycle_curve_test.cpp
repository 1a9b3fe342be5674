#include "metrics/cycle_curve.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

GaitEvent strike(double time, Side side) { return {time, side, GaitEventKind::kFootStrike}; }

TEST(StridesOf, GoFromStrikeToStrikeOfOneFoot) {
  Gait gait;
  gait.events = {
      strike(0.2, Side::kLeft),  {0.3, Side::kRight, GaitEventKind::kToeOff},
      strike(0.8, Side::kRight), {0.95, Side::kLeft, GaitEventKind::kToeOff},
      strike(1.4, Side::kLeft),  strike(3.3, Side::kLeft)};  // the next pass of a walkway
  const auto strides = strides_of(gait);
  ASSERT_EQ(strides.size(), 1u);
  EXPECT_EQ(strides[0].side, Side::kLeft);
  EXPECT_EQ(strides[0].from, 0.2);
  EXPECT_EQ(strides[0].to, 1.4);
  EXPECT_DOUBLE_EQ(strides[0].toe_off, (0.95 - 0.2) / 1.2);
}

TEST(StridesOf, WithoutStrikesThereAreNone) { EXPECT_TRUE(strides_of(Gait{}).empty()); }

TEST(OverStride, IsExactForALine) {
  const std::vector<double> time{0, 0.5, 1, 1.5, 2}, values{0, 1, 2, 3, 4};
  const CycleCurve curve = over_stride(time, values, {Side::kLeft, 0.3, 1.7});
  for (size_t i = 0; i < kCyclePoints; ++i)
    EXPECT_NEAR(curve[i], 2 * (0.3 + 1.4 * double(i) / 100), 1e-12) << i;
}

TEST(OverStride, StretchesAnyStrideToTheSameCurve) {
  // A sine of the stride's own period, sampled finely: the chord error is (pi dt / T)^2 / 2.
  const auto sine_curve = [](double period) {
    std::vector<double> time, values;
    for (int i = 0; i <= 2000; ++i) {
      time.push_back(period * i / 1000.0);
      values.push_back(std::sin(2 * std::numbers::pi * time.back() / period));
    }
    return over_stride(time, values, {Side::kLeft, 0.25 * period, 1.25 * period});
  };
  const CycleCurve slow = sine_curve(1.7), fast = sine_curve(0.8);
  for (size_t i = 0; i < kCyclePoints; ++i) {
    EXPECT_NEAR(slow[i], fast[i], 1e-5);
    EXPECT_NEAR(slow[i], std::cos(2 * std::numbers::pi * double(i) / 100), 1e-5);
  }
}

TEST(OverStride, KnowsNothingInGapsAndOutside) {
  const std::vector<double> time{0, 1, 2, 3, 4}, values{0, 1, kNaN, 3, 4};
  const CycleCurve curve = over_stride(time, values, {Side::kLeft, 0, 5});
  EXPECT_EQ(curve[0], 0);
  EXPECT_EQ(curve[20], 1);
  EXPECT_TRUE(std::isnan(curve[30]));
  EXPECT_TRUE(std::isnan(curve[50]));
  EXPECT_EQ(curve[80], 4);
  EXPECT_TRUE(std::isnan(curve[81]));
}

TEST(BandOf, IsMeanAndSampleDeviationOfWholeCurves) {
  std::array<CycleCurve, 4> curves;
  for (size_t k = 0; k < 3; ++k) curves[k].fill(double(k) * 2);  // 0, 2, 4
  curves[3].fill(100);
  curves[3][50] = kNaN;  // left out altogether
  const CycleBand band = band_of(curves);
  EXPECT_EQ(band.count, 3u);
  EXPECT_DOUBLE_EQ(band.mean[7], 2);
  EXPECT_DOUBLE_EQ(band.sd[7], 2);
  EXPECT_EQ(band_of(std::span(curves).first(1)).sd[0], 0);
  EXPECT_TRUE(std::isnan(band_of(std::span(curves).last(1)).mean[0]));
}

}  // namespace
}  // namespace walktrack
