#include "kinetics/smoothing.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "sample_motions.h"

namespace walktrack {
namespace {

// Amplitude at the middle of a long sine after smoothing.
double gain(double frequency, double cutoff, double rate) {
  std::vector<double> sine;
  for (int i = 0; i < 1001; ++i) sine.push_back(std::cos(2 * kPi * frequency * (i - 500) / rate));
  return low_pass(sine, rate, cutoff)[500];
}

TEST(LowPass, HalvesThePowerAtTheCutOffAndKeepsTheRest) {
  EXPECT_NEAR(gain(6, 6, 100), std::sqrt(0.5), 2e-3);  // Butterworth's definition
  EXPECT_NEAR(gain(1, 6, 100), 1, 2e-3);               // 1 / (1 + (1 / 7.5)^4)
  EXPECT_LT(gain(24, 6, 100), 0.02);
  EXPECT_NEAR(gain(6, 6, 1000), std::sqrt(0.5), 2e-3);  // for any rate
}

TEST(LowPass, HasNoLagAndKeepsStraightLines) {
  std::vector<double> line;
  for (int i = 0; i < 60; ++i) line.push_back(3 - 0.2 * i);
  const std::vector<double> same = low_pass(line, 30, 6);
  // After two periods the effect of the continuation has decayed to a millionth of the line's
  // change, 2.
  for (size_t i = 0; i < line.size(); ++i) EXPECT_NEAR(same[i], line[i], 2e-5);
  // A pulse is not shifted: it is symmetric about its place.
  std::vector<double> pulse(101, 0);
  pulse[50] = 1;
  const std::vector<double> wide = low_pass(pulse, 100, 6);
  for (size_t k = 1; k < 30; ++k) EXPECT_NEAR(wide[50 - k], wide[50 + k], 1e-6);
}

TEST(LowPass, LeavesAloneWhatItCannotOrNeedNotSmooth) {
  const std::vector<double> values{1, 5, 2, 7, 3};
  EXPECT_EQ(low_pass(values, 100, 0), values);
  EXPECT_EQ(low_pass(values, 10, 6), values);  // above half of the rate
  EXPECT_EQ(low_pass(std::vector<double>{1, 2}, 100, 6), (std::vector<double>{1, 2}));
}

TEST(Smoothed, JointsWithAGapInTheSpanBecomeUnknown) {
  Motion motion = motion_by([](double) { return joints_of(standing()); }, 20);
  motion.joints[7][Joint::kHead].setConstant(NAN);
  const auto rows = smoothed(motion, {2, 18}, kSampleRate, 6);
  ASSERT_EQ(rows.size(), 16u);
  EXPECT_FALSE(known(rows[0][Joint::kHead]));
  EXPECT_TRUE(known(rows[5][Joint::kNeck]));
}

}  // namespace
}  // namespace walktrack
