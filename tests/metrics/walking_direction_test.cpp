#include "metrics/steps/walking_direction.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "metrics/gait.h"
#include "tests/body/changed_motion.h"
#include "tests/metrics/test_walk.h"

namespace walktrack {
namespace {

// The same walk with a pelvis that is over each foot while that foot stands: 5 cm to either side.
Motion swaying(const TestWalk& walk) {
  const Motion even = walk_motion(walk);
  return changed(even, [&](JointPositions& joints, size_t i) {
    const double stride = even.time[i] / (2 * walk.step_time) + walk.phase;
    const double side = 0.05 * std::sin(2 * kPi * (stride - walk.stance_share / 2 + 0.25));
    joints[Joint::kPelvis] += Eigen::Vector3d(0, side, 0);
  });
}

double off_deg(const Eigen::Vector2d& way) { return deg_from_rad(std::atan2(way.y(), way.x())); }

// Law: swaying from foot to foot does not change where somebody goes,
TEST(WalkingDirection, SwayDoesNotChangeIt) {
  for (const double speed : {0.5, 1.2}) {
    const TestWalk walk{.speed = speed};
    const Motion motion = swaying(walk);
    for (double time = 0; time < 4.9; time += 0.07)
      EXPECT_NEAR(off_deg(walking_direction(motion, time, 2 * walk.step_time)), 0, 0.5) << time;
  }
}

// and neither how long nor how wide the steps are: twice as many of the cadence are the speed.
TEST(WalkingDirection, StepsOfWhoeverSwaysAreAsLongAndWide) {
  const TestWalk walk{.speed = 0.5, .step_width = 0.15};
  for (const Gait& gait : {gait_from_motion(walk_motion(walk)), gait_from_motion(swaying(walk))}) {
    EXPECT_NEAR(gait.mean_step_length, walk.speed * walk.step_time, 2e-3);
    EXPECT_NEAR(gait.mean_step_width, walk.step_width, 3e-3);
  }
}

// Sums of times are rounded.
TEST(WalkingDirection, IsKnownToTheEndsWhateverTheStride) {
  for (const double rate : {30.0, 29.97, 60.0}) {
    const TestWalk walk{.rate = rate};
    const Motion motion = walk_motion(walk);
    for (double stride = 0.9; stride < 9; stride *= 1.003) {
      EXPECT_NEAR(off_deg(walking_direction(motion, motion.time.back(), stride)), 0, 1) << stride;
      EXPECT_NEAR(off_deg(walking_direction(motion, motion.time.front(), stride)), 0, 1) << stride;
    }
  }
}

TEST(WalkingDirection, FollowsATurn) {
  Motion motion = walk_motion({.speed = 1});
  for (size_t i = 0; i < motion.time.size(); ++i) {
    const double angle = 0.5 * motion.time[i];
    motion.joints[i][Joint::kPelvis] = {2 * std::sin(angle), 2 * (1 - std::cos(angle)), 0.9};
  }
  for (const double time : {1.0, 2.0, 4.0})
    EXPECT_NEAR(off_deg(walking_direction(motion, time, 1.1)), deg_from_rad(0.5 * time), 1) << time;
}

TEST(WalkingDirection, StaysOnItsSideOfAGap) {
  Motion motion = changed(walk_motion({}), [](JointPositions& joints, size_t i) {
    if (i >= 60 && i < 70) joints = unknown_joints();
    if (i >= 70) joints[Joint::kPelvis].y() += 3;
  });
  for (const double time : {0.1, 1.9, 2.4, 4.8})
    EXPECT_NEAR(off_deg(walking_direction(motion, time, 1.1)), 0, 1e-6) << time;
  EXPECT_FALSE(walking_direction(motion, 2.1, 1.1).allFinite());
  EXPECT_FALSE(walking_direction(motion, 7, 1.1).allFinite());
  EXPECT_FALSE(walking_direction({}, 0, 1.1).allFinite());
}

TEST(OnGround, IsLinearBetweenRows) {
  const Motion motion = walk_motion({.speed = 1.5});
  EXPECT_NEAR(on_ground(motion, Joint::kPelvis, 0.05).x(), 0.075, 1e-12);
  EXPECT_NEAR(on_ground(motion, Joint::kPelvis, 0).x(), 0, 1e-12);
  EXPECT_FALSE(on_ground(motion, Joint::kPelvis, -0.01).allFinite());
  EXPECT_FALSE(on_ground(motion, Joint::kPelvis, 6).allFinite());
}

}  // namespace
}  // namespace walktrack
