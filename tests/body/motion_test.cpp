#include "body/motion.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/errors.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;

// A motion in which every joint is at f(t) on each axis.
template <typename F>
Motion motion_of(std::vector<double> times, F f) {
  Motion motion{std::move(times), {}};
  for (const double t : motion.time) {
    JointPositions joints;
    joints.at.fill(Vector3d::Constant(f(t)));
    motion.joints.push_back(joints);
  }
  return motion;
}

double line(double t) { return 3 * t - 1; }
double parabola(double t) { return 4 * t * t - t; }

TEST(Resampled, KeepsRowsAndReproducesLinesAndParabolas) {
  const std::vector<double> times{0, .1, .2, .3, .4};
  const std::vector<double> wanted{0, .05, .1, .17, .33, .4};
  for (const auto f : {line, parabola}) {
    const Motion out = resampled(motion_of(times, f), wanted, 0.15);
    for (size_t i = 0; i < wanted.size(); ++i)
      EXPECT_NEAR(out.joints[i][Joint::kHead].y(), f(wanted[i]), 1e-12) << wanted[i];
  }
}

TEST(Resampled, IsUnknownOutsideInGapsAndBesideUnknownRows) {
  Motion motion = motion_of({0, .1, .2, .5, .6}, line);
  motion.joints[4][Joint::kHead].x() = std::nan("");
  const Motion out =
      resampled(motion, std::vector<double>{-.1, .15, .3, .5, .55, .7}, /*longest_gap=*/0.15);
  const std::vector<bool> expected{false, true, false, true, false, false};
  for (size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(known(out.joints[i][Joint::kHead]), expected[i]) << out.time[i];
  EXPECT_TRUE(known(out.joints[4][Joint::kNeck]));  // its neighbours are known
}

TEST(Resampled, ConvergesAtThirdOrderOrBetter) {
  const auto wave = [](double t) { return std::sin(2 * t); };
  double error[2];
  for (int k = 0; k < 2; ++k) {
    const double step = k == 0 ? 0.1 : 0.05;
    std::vector<double> times, wanted;
    for (double t = -1; t < 1.001; t += step) times.push_back(t);
    for (double t = -0.5; t < 0.5; t += 0.013) wanted.push_back(t);
    const Motion out = resampled(motion_of(times, wave), wanted, 1);
    error[k] = 0;
    for (size_t i = 0; i < wanted.size(); ++i)
      error[k] = std::max(error[k], std::abs(out.joints[i][Joint::kNeck].z() - wave(wanted[i])));
  }
  EXPECT_LT(error[1], error[0] / 7);  // a third-order method gains 8
}

TEST(SamplePeriod, IsTheMedianStepAndNeedsTwoRows) {
  EXPECT_DOUBLE_EQ(sample_period(motion_of({0, .5, 1, 4}, line)), .5);
  EXPECT_THROW(sample_period(motion_of({0}, line)), InputError);
}

}  // namespace
}  // namespace walktrack
