#include "body/joint_angles.h"

#include <gtest/gtest.h>

namespace walktrack {
namespace {

Pose some_pose() {
  Pose pose;
  pose.heading = 0.3;
  pose.list = 0.08;
  pose.tilt = 0.1;
  pose.legs[0] = {0.5, 0.1, -0.2, 0.6, 0.1};
  pose.legs[1] = {-0.3, -0.05, 0.15, 0.2, -0.2};
  return pose;
}

TEST(JointAngles, UprightIsZero) {
  for (const double angle : joint_angles({})) EXPECT_EQ(angle, 0);
}

// A mirrored pose has the other side's angles; rotations to a side change sign, tilts do not.
TEST(JointAngles, OfAMirroredPoseAreExchanged) {
  const Pose pose = some_pose();
  Pose mirror = pose;
  mirror.heading = -pose.heading;
  mirror.list = -pose.list;
  std::swap(mirror.legs[0], mirror.legs[1]);
  const JointAngles a = joint_angles(pose), b = joint_angles(mirror);
  for (size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(a[kHipFlexionR + k], b[kHipFlexionL + k], 1e-12);
    EXPECT_NEAR(a[kHipFlexionL + k], b[kHipFlexionR + k], 1e-12);
  }
  for (const JointAngle same : {kPelvisTilt, kLumbarExtension, kTrunkTilt})
    EXPECT_NEAR(a[same], b[same], 1e-12);
  for (const JointAngle opposite : {kPelvisList, kPelvisRotation, kLumbarBending, kLumbarRotation})
    EXPECT_NEAR(a[opposite], -b[opposite], 1e-12);
}

TEST(JointAngles, TheHeadingTurnsThePelvisAlone) {
  Pose pose = some_pose();
  const JointAngles before = joint_angles(pose);
  pose.heading += 1;
  const JointAngles after = joint_angles(pose);
  for (size_t k = kHipFlexionR; k < kJointAngleCount; ++k) EXPECT_NEAR(before[k], after[k], 1e-12);
  pose = {};
  pose.heading = 0.4;
  EXPECT_NEAR(joint_angles(pose)[kPelvisRotation], 0.4, 1e-12);
}

TEST(JointAngles, TheTrunkIsUprightOverAListedPelvis) {
  Pose pose;
  pose.list = 0.1;
  const JointAngles angles = joint_angles(pose);
  EXPECT_NEAR(angles[kPelvisList], 0.1, 1e-12);
  EXPECT_NEAR(angles[kLumbarBending], -0.1, 1e-12);
  EXPECT_EQ(angles[kTrunkTilt], 0);
}

}  // namespace
}  // namespace walktrack
