#include "metrics/statistics/mean_difference.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/rng.h"

namespace walktrack {
namespace {

using Curves = std::vector<std::vector<double>>;

// Smooth curves about zero: strides of one walker differ by a level and slow waves.
Curves made_curves(size_t count, size_t points, Rng& rng) {
  Curves curves;
  for (size_t i = 0; i < count; ++i) {
    std::vector<double> curve(points, rng.normal());
    for (int wave = 1; wave <= 5; ++wave) {
      const double sine = rng.normal() / wave, cosine = rng.normal() / wave;
      for (size_t k = 0; k < points; ++k) {
        const double angle =
            2 * std::numbers::pi * wave * static_cast<double>(k) / static_cast<double>(points);
        curve[k] += sine * std::sin(angle) + cosine * std::cos(angle);
      }
    }
    curves.push_back(curve);
  }
  return curves;
}

bool holds_zero(const MeanDifference& found) {
  for (size_t k = 0; k < found.difference.size(); ++k)
    if (!(found.low[k] <= 0 && found.high[k] >= 0)) return false;
  return true;
}

// Share of comparisons between equal groups in which the whole band contains zero.
double coverage(size_t count, size_t points) {
  constexpr int kTrials = 200;
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Rng rng(7, Purpose::kTest, static_cast<uint32_t>(trial), static_cast<uint32_t>(count));
    const Curves a = made_curves(count, points, rng), b = made_curves(count, points, rng);
    held += holds_zero(mean_difference(a, b, 0.95, 300, 1));
  }
  return double(held) / kTrials;
}

// 200 trials of 95 % have a standard error of 1.5 %.
TEST(MeanDifference, BandHoldsAWholeCurveAsOftenAsItSays) {
  for (const size_t count : {3, 5, 8, 15}) EXPECT_GE(coverage(count, 51), 0.93) << count;
  EXPECT_LE(coverage(15, 51), 0.995);  // nor is it too wide to be useful
}

TEST(MeanDifference, BandHoldsANumberAsOftenAsItSays) {
  for (const size_t count : {3, 5, 8, 15}) EXPECT_GE(coverage(count, 1), 0.915) << count;
}

TEST(MeanDifference, FindsADifferenceWhereItIs) {
  Rng rng(3, Purpose::kTest);
  Curves a = made_curves(10, 101, rng), b = made_curves(10, 101, rng);
  for (auto& curve : a)
    for (size_t k = 0; k < 101; ++k) curve[k] += k >= 40 && k <= 60 ? 12 : 0;
  const MeanDifference found = mean_difference(a, b, 0.95, 500, 1);
  EXPECT_GT(found.low[50], 0);
  EXPECT_LE(found.low[10], 0);
  EXPECT_NEAR(found.difference[50] - found.difference[10], 12, 4);
}

TEST(MeanDifference, IsTheSameForTheSameSeed) {
  Rng rng(4, Purpose::kTest);
  const Curves a = made_curves(4, 11, rng), b = made_curves(5, 11, rng);
  EXPECT_EQ(mean_difference(a, b, 0.95, 100, 2).low, mean_difference(a, b, 0.95, 100, 2).low);
  EXPECT_NE(mean_difference(a, b, 0.95, 100, 2).low, mean_difference(a, b, 0.95, 100, 3).low);
}

TEST(MeanDifference, OfTooFewHasNoBand) {
  const Curves two{{1}, {2}}, three{{1}, {2}, {4}};
  const MeanDifference found = mean_difference(three, two, 0.95, 100, 1);
  EXPECT_NEAR(found.difference[0], 7.0 / 3 - 1.5, 1e-12);
  EXPECT_TRUE(std::isnan(found.low[0]) && std::isnan(found.high[0]));
}

TEST(MeanDifference, OfEqualCurvesIsCertain) {
  const Curves same{{1, 2}, {1, 2}, {1, 2}}, other{{0, 2}, {0, 2}, {0, 2}};
  const MeanDifference found = mean_difference(same, other, 0.95, 100, 1);
  EXPECT_EQ(found.low, (std::vector<double>{1, 0}));
  EXPECT_EQ(found.high, (std::vector<double>{1, 0}));
}

TEST(SampleSpread, IsOfASample) {
  const std::vector<double> values{1, 2, 3, 6};
  const SampleSpread spread = sample_spread(values);
  EXPECT_EQ(spread.count, 4u);
  EXPECT_DOUBLE_EQ(spread.mean, 3);
  EXPECT_DOUBLE_EQ(spread.sd, std::sqrt(14.0 / 3));
  EXPECT_TRUE(std::isnan(sample_spread(std::vector<double>{5}).sd));
}

// As printed in tables of the distribution.
TEST(StudentsT, IsThatOfTheTables) {
  EXPECT_NEAR(students_t(0.025, 1), 12.7062, 1e-3);
  EXPECT_NEAR(students_t(0.025, 2), 4.30265, 1e-4);
  EXPECT_NEAR(students_t(0.025, 5), 2.57058, 1e-5);
  EXPECT_NEAR(students_t(0.025, 30), 2.04227, 1e-5);
  EXPECT_NEAR(students_t(0.025, 1000), 1.96234, 1e-5);
  EXPECT_NEAR(students_t(0.05, 2.5), 2.558219, 1e-4);
}

}  // namespace
}  // namespace walktrack
