#include "metrics/steps/foot_placement.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/conventions.h"
#include "tests/body/changed_motion.h"
#include "tests/metrics/test_walk.h"

namespace walktrack {
namespace {

constexpr size_t kMiddle = 4;  // a stance that has neighbours

TEST(ToeClearance, IsTheLowestHeightWhileTheToeIsFast) {
  const TestWalk walk;
  const Motion motion = walk_motion(walk);
  // Height 0.4 u (1 - u) of the swing's share u; the speed 6 u (1 - u) is 80 % of its highest at
  // .276 and .724.
  const double expected = 0.4 * 0.276 * 0.724;
  EXPECT_NEAR(toe_clearance(motion, gait_from_motion(motion), kMiddle), expected, 0.01);
}

TEST(ToeClearance, OfAFootThatDipsInTheMiddle) {
  const TestWalk walk{.rate = 120};
  const Motion motion = changed(walk_motion(walk), [](JointPositions& joints, size_t) {
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const double up = joints[toe(side)].z() - 0.02;  // at most 0.1
      joints[toe(side)].z() = 0.05 + (up < 0.09 ? up : 0.09 - 7 * (up - 0.09));
    }
  });
  EXPECT_NEAR(toe_clearance(motion, gait_from_motion(motion), kMiddle), 0.02, 2e-3);
}

TEST(ToeClearance, UnknownWhereTheSwingIs) {
  const Motion whole = walk_motion({});
  const Gait gait = gait_from_motion(whole);
  EXPECT_TRUE(std::isnan(toe_clearance(whole, gait, gait.stances.size() - 1))) << "no next stance";
  const Motion gap = changed(whole, [&](JointPositions& joints, size_t i) {
    const double since = whole.time[i] - gait.stances[kMiddle].off;
    if (since > 0.1 && since < 0.2) joints = unknown_joints();
  });
  EXPECT_TRUE(std::isnan(toe_clearance(gap, gait, kMiddle)));
}

// A foot that comes down in another walk has not swung all the time.
TEST(ToeClearance, EndsWithAWalk) {
  const Motion motion = walk_motion({});
  Gait gait = gait_from_motion(motion);
  for (size_t i = kMiddle + 1; i < gait.stances.size(); ++i) gait.stances[i].on += 1.5;
  EXPECT_TRUE(std::isnan(toe_clearance(motion, gait, kMiddle)));
}

// Whose toes point outwards by 12 degrees on either side, wherever the person goes.
TEST(FootProgression, IsPositiveOutwards) {
  for (const double heading : {0.0, 2.0, -2.5}) {
    const TestWalk walk{.heading = heading};
    const Motion motion = changed(walk_motion(walk), [](JointPositions& joints, size_t) {
      for (const Side side : {Side::kLeft, Side::kRight}) {
        const Eigen::AngleAxisd turn(outward(side) * rad_from_deg(12), Eigen::Vector3d::UnitZ());
        joints[toe(side)] = joints[ankle(side)] + turn * (joints[toe(side)] - joints[ankle(side)]);
      }
    });
    const Gait gait = gait_from_motion(motion);
    for (const size_t stance : {kMiddle, kMiddle + 1})
      EXPECT_NEAR(foot_progression_deg(motion, gait, stance), 12, 0.5) << heading;
  }
}

TEST(WidthAtStrike, AndWalkingBaseAreTheDistanceBetweenTheLinesOfTheFeet) {
  for (const double heading : {0.0, 2.0}) {
    for (const double width : {0.12, -0.03}) {  // crossing over is negative
      const TestWalk walk{.step_width = width, .heading = heading};
      const Motion motion = walk_motion(walk);
      const Gait gait = gait_from_motion(motion);
      for (const size_t stance : {kMiddle, kMiddle + 1}) {
        EXPECT_NEAR(width_at_strike(motion, gait, stance), width, 2e-3);
        EXPECT_NEAR(walking_base(gait, stance), width, 2e-3);
        EXPECT_NEAR(turn_deg(motion, gait, stance), 0, 0.5);
      }
    }
  }
}

TEST(Turn, IsThatOfTheWayAtEveryStep) {
  constexpr double kRate = 0.4;  // rad/s, to the left
  const TestWalk walk;
  const Motion straight = walk_motion(walk);
  const Gait gait = gait_from_motion(straight);
  const Motion turning = changed(straight, [&](JointPositions& joints, size_t i) {
    const double angle = kRate * straight.time[i], radius = walk.speed / kRate;
    joints[Joint::kPelvis].head<2>() =
        radius * Eigen::Vector2d(std::sin(angle), 1 - std::cos(angle));
  });
  EXPECT_NEAR(turn_deg(turning, gait, kMiddle), deg_from_rad(kRate * walk.step_time), 0.5);
  const Motion mirrored =
      changed(turning, [](JointPositions& joints, size_t) { joints[Joint::kPelvis].y() *= -1; });
  EXPECT_NEAR(turn_deg(mirrored, gait, kMiddle), -deg_from_rad(kRate * walk.step_time), 0.5);
}

TEST(FootPath, NothingIsKnownAtTheEnds) {
  const Motion motion = walk_motion({});
  const Gait gait = gait_from_motion(motion);
  const size_t last = gait.stances.size() - 1;
  EXPECT_TRUE(std::isnan(walking_base(gait, 0)));
  EXPECT_TRUE(std::isnan(walking_base(gait, last)));
  EXPECT_TRUE(std::isnan(turn_deg(motion, gait, 0)));
  EXPECT_TRUE(std::isnan(turn_deg(motion, gait, last)));
  EXPECT_TRUE(std::isnan(width_at_strike(motion, gait, 0)));
}

}  // namespace
}  // namespace walktrack
