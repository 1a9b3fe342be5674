#include "body/pose_from_joints.h"

#include <cmath>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "body/motion.h"
#include "core/conventions.h"
#include "core/rng.h"
#include "tests/body/draw.h"

namespace walktrack {
namespace {

Pose bent_pose(Rng& rng) {
  Pose pose;
  for (double& x : pose.root) x = draw(rng, 3);
  pose.heading = draw(rng, kPi);
  pose.list = draw(rng, 0.3);
  pose.tilt = draw(rng, 0.5);
  // Knees from slightly over-straight to 69 degrees, hips within a quarter turn.
  for (LegPose& leg : pose.legs)
    leg = {draw(rng, 1), draw(rng, 0.4), draw(rng, 0.4), 0.5 + draw(rng, 0.7), draw(rng, 0.6)};
  for (ArmPose& arm : pose.arms) arm = {draw(rng, 1), draw(rng, 0.6), 0.6 + draw(rng, 0.6)};
  return pose;
}

TEST(PoseFromJoints, InvertsForwardKinematics) {
  const Body body = make_body(Subject{}, {.head = true, .arms = true});
  Rng rng(11, Purpose::kTest);
  for (int i = 0; i < 500; ++i) {
    const Pose pose = bent_pose(rng);
    const auto found = pose_from_joints(forward_kinematics(body, pose).joints, body.lengths);
    ASSERT_TRUE(found.has_value());
    // 1e-9 rad: rounding of an arcsine near a quarter turn loses half the digits of 1e-16.
    EXPECT_TRUE(found->root.isApprox(pose.root, 1e-12));
    EXPECT_NEAR(found->heading, pose.heading, 1e-9);
    EXPECT_NEAR(found->list, pose.list, 1e-9);
    EXPECT_NEAR(found->tilt, pose.tilt, 1e-9);
    for (size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(found->legs[k].hip_flexion, pose.legs[k].hip_flexion, 1e-9);
      EXPECT_NEAR(found->legs[k].hip_abduction, pose.legs[k].hip_abduction, 1e-9);
      EXPECT_NEAR(found->legs[k].hip_rotation, pose.legs[k].hip_rotation, 1e-9);
      EXPECT_NEAR(found->legs[k].knee_flexion, pose.legs[k].knee_flexion, 1e-9);
      EXPECT_NEAR(found->legs[k].ankle_dorsiflexion, pose.legs[k].ankle_dorsiflexion, 1e-9);
      EXPECT_NEAR(found->arms[k].shoulder_flexion, pose.arms[k].shoulder_flexion, 1e-9);
      EXPECT_NEAR(found->arms[k].shoulder_abduction, pose.arms[k].shoulder_abduction, 1e-9);
      EXPECT_NEAR(found->arms[k].elbow_flexion, pose.arms[k].elbow_flexion, 1e-9);
    }
  }
}

TEST(PoseFromJoints, NeedsTheLegsAndNothingElse) {
  const Body body = make_body(Subject{}, {.head = true, .arms = false});
  Pose pose;
  pose.legs[0].knee_flexion = 0.4;
  JointPositions joints = forward_kinematics(body, pose).joints;
  const Eigen::Vector3d unknown = unknown_joints()[Joint::kHead];
  for (const Joint joint : {Joint::kPelvis, Joint::kNeck, Joint::kHead, Joint::kLeftToe,
                            Joint::kRightToe, Joint::kLeftShoulder, Joint::kRightWrist})
    joints[joint] = unknown;
  const auto found = pose_from_joints(joints, body.lengths);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->legs[0].knee_flexion, 0.4, 1e-9);
  for (const Joint joint : {Joint::kLeftHip, Joint::kRightKnee, Joint::kLeftAnkle}) {
    JointPositions without = joints;
    without[joint] = unknown;
    EXPECT_FALSE(pose_from_joints(without, body.lengths).has_value());
  }
  joints[Joint::kLeftHip] = joints[Joint::kRightHip];
  EXPECT_FALSE(pose_from_joints(joints, body.lengths).has_value());
}

}  // namespace
}  // namespace walktrack
