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
}

TEST(Coverage, ComparesOnlyEqualTimesAndKnownJoints) {
  const Motion truth = walk_motion({});
  JointUncertainty shifted = intervals_around(truth, 0.1);
  for (double& t : shifted.time) t += 0.01;
  EXPECT_EQ(coverage(truth, shifted).scored.count, 0u);
  const CoverageReport report = coverage(truth, intervals_around(truth, 0.1));
  EXPECT_EQ(report.scored.share, 1);
  EXPECT_EQ(report.by_joint[static_cast<size_t>(Joint::kHead)].count, 0u);  // unknown in this walk
}

}  // namespace
}  // namespace walktrack
