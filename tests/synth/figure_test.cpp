#include "synth/world/figure.h"

#include <gtest/gtest.h>

#include "core/errors.h"
#include "core/rng.h"

namespace walktrack {
namespace {

double draw(Rng& rng, double limit) { return limit * (2 * rng.uniform() - 1); }

Pose random_pose(Rng& rng) {
  Pose pose;
  for (double& x : pose.root) x = draw(rng, 3);
  pose.heading = draw(rng, 3);
  pose.tilt = draw(rng, 0.3);
  for (LegPose& leg : pose.legs)
    leg = {draw(rng, 0.6), draw(rng, 0.2), draw(rng, 0.3), 0.5 + draw(rng, 0.5), draw(rng, 0.4)};
  for (ArmPose& arm : pose.arms) arm = {draw(rng, 0.6), 0.1, 0.5 + draw(rng, 0.4)};
  return pose;
}

Motion motion_of_poses(const Body& body, int count) {
  Rng rng(9, Purpose::kTest);
  Motion motion;
  for (int i = 0; i < count; ++i) {
    motion.time.push_back(i / 30.0);
    motion.joints.push_back(forward_kinematics(body, random_pose(rng)).joints);
  }
  return motion;
}

TEST(SkeletonFromJoints, HasTheAxesThatForwardKinematicsHad) {
  const Body body = make_body(Subject{}, {.head = true, .arms = true});
  Rng rng(1, Purpose::kTest);
  for (int i = 0; i < 200; ++i) {
    const Skeleton expected = forward_kinematics(body, random_pose(rng));
    const auto found = skeleton_from_joints(body, expected.joints);
    ASSERT_TRUE(found.has_value());
    for (size_t s = 0; s < kSegmentCount; ++s) {
      const bool leg_or_trunk = s <= static_cast<size_t>(Segment::kRightFoot);
      // Arms rotate about their long axis with the trunk: nearly equal, and hardly visible.
      const double tolerance = leg_or_trunk ? 1e-9 : 0.35;
      EXPECT_TRUE(found->world_from_segment[s].isApprox(expected.world_from_segment[s], tolerance))
          << s;
    }
    const Segment fore = Segment::kLeftForearm;
    EXPECT_TRUE(found->axes(fore).col(2).isApprox(expected.axes(fore).col(2), 1e-9));
  }
}

TEST(SkeletonFromJoints, NeedsLegsAndArmsOfABodyWithArms) {
  const Body with = make_body(Subject{}, {.head = true, .arms = true});
  const Body without = make_body(Subject{}, {.head = true, .arms = false});
  JointPositions joints = forward_kinematics(with, Pose{}).joints;
  joints[Joint::kLeftWrist] = unknown_joints()[Joint::kLeftWrist];
  joints[Joint::kNeck] = joints[Joint::kLeftToe] = joints[Joint::kLeftWrist];
  EXPECT_FALSE(skeleton_from_joints(with, joints).has_value());
  const auto found = skeleton_from_joints(without, joints);
  ASSERT_TRUE(found.has_value());
  for (size_t s = 0; s <= static_cast<size_t>(Segment::kRightFoot); ++s)
    EXPECT_TRUE(found->world_from_segment[s].allFinite());
  joints[Joint::kRightKnee] = joints[Joint::kNeck];
  EXPECT_FALSE(skeleton_from_joints(without, joints).has_value());
}

TEST(BodyFromMotion, TakesTheLengthsOfTheBones) {
  Subject subject;
  subject.height = 1.62;
  subject.lengths.thigh = 0.45;
  subject.lengths.trunk = 0.51;
  const Body body = make_body(subject, {.head = true, .arms = true});
  const Body found = body_from_motion(motion_of_poses(body, 21), 1.62);
  EXPECT_TRUE(found.groups.arms);
  EXPECT_NEAR(found.lengths.thigh, 0.45, 1e-9);
  EXPECT_NEAR(found.lengths.trunk, 0.51, 1e-9);
  EXPECT_NEAR(found.lengths.shank, body.lengths.shank, 1e-9);
  EXPECT_NEAR(found.lengths.shoulder_width, body.lengths.shoulder_width, 1e-9);
}

TEST(BodyFromMotion, NeedsTheLegsOnce) {
  EXPECT_THROW(body_from_motion({{0.0}, {unknown_joints()}}, 1.7), InputError);
}

}  // namespace
}  // namespace walktrack
