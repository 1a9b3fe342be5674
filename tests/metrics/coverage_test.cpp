#include "metrics/statistics/coverage.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/rng.h"
#include "tests/metrics/test_walk.h"

namespace walktrack {
namespace {

JointUncertainty intervals_around(const Motion& motion, double half_width) {
  JointUncertainty out{motion.time, motion.joints, motion.joints, motion.joints};
  for (size_t i = 0; i < motion.time.size(); ++i) {
    for (size_t j = 0; j < kJointCount; ++j) {
      out.p05[i].at[j].array() -= half_width;
      out.p95[i].at[j].array() += half_width;
    }
  }
  return out;
}

TEST(Coverage, OfCalibratedGaussianIntervalsIsNinePartsInTen) {
  const Motion truth = walk_motion({});
  const double sd = 0.02;
  Rng rng(5, Purpose::kTest);
  const Motion estimate = changed(truth, [&](JointPositions& joints, size_t) {
    for (Eigen::Vector3d& p : joints.at)
      for (double& x : p) x += sd * rng.normal();
  });
  const CoverageReport report = coverage(truth, intervals_around(estimate, 1.6448536 * sd));
  const double n = static_cast<double>(report.scored.count);
  EXPECT_EQ(report.scored.count, truth.time.size() * 7 * 3);
  EXPECT_NEAR(report.scored.share, 0.90, 5 * std::sqrt(.9 * .1 / n));
  EXPECT_NEAR(report.scored.mean_width, 2 * 1.6448536 * sd, 1e-9);
  for (size_t k = 0; k < kIntervalLevels.size(); ++k) {
    const double level = kIntervalLevels[k];
    EXPECT_NEAR(report.scored.share_of_level[k], level, 5 * std::sqrt(level * (1 - level) / n));
  }
  EXPECT_LT(calibration_error(report.scored), 0.01);
}

// Twice and half as wide as they should be: the levels that such intervals really have are known
// from the normal distribution.
TEST(Coverage, CalibrationErrorSeesWhatIsTooWideOrTooNarrow) {
  const Motion truth = walk_motion({});
  Rng rng(6, Purpose::kTest);
  const Motion estimate = changed(truth, [&](JointPositions& joints, size_t) {
    for (Eigen::Vector3d& p : joints.at)
      for (double& x : p) x += 0.02 * rng.normal();
  });
  for (const double factor : {0.5, 2.0}) {
    const Coverage all =
        coverage(truth, intervals_around(estimate, factor * 1.6448536 * 0.02)).scored;
    double expected = 0;
    for (size_t k = 0; k < kIntervalLevels.size(); ++k) {
      constexpr double kHalf[] = {.12566, .25335,  .38532,  .5244,  .67449,
                                  .84162, 1.03643, 1.28155, 1.64485};
      expected += std::abs(std::erf(factor * kHalf[k] / std::sqrt(2)) - kIntervalLevels[k]) / 9;
    }
    EXPECT_NEAR(calibration_error(all), expected, 0.02);
    EXPECT_GT(expected, 0.15);
  }
  EXPECT_NEAR(calibration_error(coverage(truth, intervals_around(truth, 1)).scored), 0.5, 1e-12);
}

TEST(Coverage, DirectionsAreApart) {
  const Motion truth = walk_motion({});
  const Motion lifted = changed(truth, [&](JointPositions& joints, size_t) {
    for (Eigen::Vector3d& p : joints.at) p.z() += 0.05;
  });
  const CoverageReport report = coverage(truth, intervals_around(lifted, 0.02));
  EXPECT_EQ(report.of(Joint::kLeftKnee, Direction::kLevel).share, 1);
  EXPECT_EQ(report.of(Joint::kLeftKnee, Direction::kUp).share, 0);
  EXPECT_NEAR(report.scored.share, 2. / 3, 1e-12);
  EXPECT_EQ(report.of(Joint::kLeftKnee, Direction::kLevel).count,
            2 * report.of(Joint::kLeftKnee, Direction::kUp).count);
}

TEST(Coverage, ComparesOnlyEqualTimesAndKnownJoints) {
  const Motion truth = walk_motion({});
  JointUncertainty shifted = intervals_around(truth, 0.1);
  for (double& t : shifted.time) t += 0.01;
  EXPECT_EQ(coverage(truth, shifted).scored.count, 0u);
  const CoverageReport report = coverage(truth, intervals_around(truth, 0.1));
  EXPECT_EQ(report.scored.share, 1);
  EXPECT_EQ(report.of(Joint::kHead, Direction::kUp).count, 0u);  // unknown in this walk
}

}  // namespace
}  // namespace walktrack
