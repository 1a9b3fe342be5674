#include "kinetics/force_error.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/conventions.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;

// Two feet with a slow wave, `rate` rows per second.
GroundForces waves(double rate, double seconds = 3) {
  GroundForces out;
  for (int i = 0; i <= static_cast<int>(seconds * rate); ++i) {
    const double t = i / rate, load = 700 + 100 * std::sin(2 * kPi * t);
    const double left = 0.5 + 0.5 * std::sin(3 * t);
    out.time.push_back(t);
    out.feet.push_back({Vector3d(10, 0, left * load), Vector3d(0, 5, (1 - left) * load)});
  }
  return out;
}

TEST(ForceErrors, AreOfTheSumWhicheverWayTheFeetShareIt) {
  GroundForces estimate = waves(60);
  for (auto& feet : estimate.feet) {
    std::swap(feet[0], feet[1]);
    feet[0] += Vector3d(3, 4, -20);
  }
  const ForceErrors e = force_errors(waves(60), estimate, 6);
  // The filter reduces a wave at a sixth of its cut-off by 2e-4.
  EXPECT_NEAR(e.vertical_rms, 20, 0.1);
  EXPECT_NEAR(e.horizontal_rms, 5, 0.1);
  EXPECT_EQ(e.count, 181u - 10u);  // half a period of 6 Hz at either end
}

TEST(ForceErrors, AnImpulseIsSmoothedBeforeItCounts) {
  GroundForces truth = waves(60);
  truth.feet[90][0].z() += 3000;
  const double smoothed = force_errors(truth, waves(60), 6).vertical_rms;
  const double raw = force_errors(truth, waves(60), 29.9).vertical_rms;
  EXPECT_GT(smoothed, 20);
  EXPECT_LT(smoothed, 0.6 * raw);
}

TEST(ForceErrors, TakesEstimatesOfAnotherRateBetweenTheirRows) {
  // Half-way between rows at 25 Hz a wave of 1 Hz and 100 N is wrong by 100 (pi / 25)^2 / 2 at
  // most.
  const ForceErrors e = force_errors(waves(60), waves(25), 6);
  EXPECT_GT(e.count, 160u);
  EXPECT_LT(e.vertical_rms, 1);
}

TEST(ForceErrors, UnknownRowsCountForNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  GroundForces estimate = waves(60), truth = waves(60);
  for (size_t i = 60; i < 70; ++i) estimate.feet[i][1].setConstant(nan);
  const size_t all = force_errors(truth, waves(60), 6).count;
  EXPECT_EQ(force_errors(truth, estimate, 6).count, all - 10);
  // A gap in the truth is the end of two intervals.
  truth.feet[100][0].setConstant(nan);
  EXPECT_EQ(force_errors(truth, waves(60), 6).count, all - 11);
  for (auto& feet : estimate.feet) feet[0].setConstant(nan);
  EXPECT_EQ(force_errors(truth, estimate, 6).count, 0u);
}

}  // namespace
}  // namespace walktrack
