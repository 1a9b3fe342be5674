#include "body/kinematics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "core/rng.h"
#include "tests/body/draw.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;

Body test_body() { return make_body(Subject{}, {.head = true, .arms = true}); }

Pose random_pose(Rng& rng) {
  Pose pose;
  for (double& x : pose.root) x = draw(rng, 3);
  pose.heading = draw(rng, kPi);
  pose.list = draw(rng, 0.3);
  pose.tilt = draw(rng, 0.5);
  for (LegPose& leg : pose.legs)
    leg = {draw(rng, 1), draw(rng, 0.3), draw(rng, 0.3), 0.6 + draw(rng, 0.6), draw(rng, 0.5)};
  for (ArmPose& arm : pose.arms) arm = {draw(rng, 1), draw(rng, 0.5), 0.6 + draw(rng, 0.6)};
  return pose;
}

Pose mirrored(const Pose& pose) {
  Pose out = pose;
  out.root.y() = -pose.root.y();
  out.heading = -pose.heading;
  out.list = -pose.list;
  std::swap(out.legs[0], out.legs[1]);
  std::swap(out.arms[0], out.arms[1]);
  return out;
}

Joint mirrored(Joint joint) {
  const int i = static_cast<int>(joint);
  if (i < 3) return joint;
  if (i < 11) return static_cast<Joint>((i - 3 + 4) % 8 + 3);
  return static_cast<Joint>((i - 11 + 3) % 6 + 11);
}

TEST(ForwardKinematics, ZeroPoseStandsUpright) {
  const Body body = test_body();
  const JointPositions j = forward_kinematics(body, Pose{}).joints;
  const double leg = body.lengths.thigh + body.lengths.shank;
  EXPECT_TRUE(j[Joint::kLeftAnkle].isApprox(Vector3d(0, body.lengths.hip_width / 2, -leg), 1e-12));
  EXPECT_GT(j[Joint::kLeftToe].x(), 0.1);
  EXPECT_GT(j[Joint::kLeftShoulder].y(), 0.1);
  EXPECT_GT(j[Joint::kHead].z(), j[Joint::kNeck].z());
}

TEST(ForwardKinematics, SignsOfTheAngles) {
  const Body body = test_body();
  Pose pose;
  LegPose& left = pose.legs[0];
  left.hip_flexion = 0.3;
  EXPECT_GT(forward_kinematics(body, pose).joints[Joint::kLeftKnee].x(), 0.05);
  left = {};
  left.knee_flexion = 0.3;
  EXPECT_LT(forward_kinematics(body, pose).joints[Joint::kLeftAnkle].x(), -0.05);
  left = {};
  left.hip_abduction = 0.3;
  EXPECT_GT(forward_kinematics(body, pose).joints[Joint::kLeftAnkle].y(), 0.2);
  left = {};
  left.hip_rotation = 0.3;
  EXPECT_LT(forward_kinematics(body, pose).joints[Joint::kLeftToe].y(),
            forward_kinematics(body, pose).joints[Joint::kLeftAnkle].y() - 0.02);
  left = {};
  left.ankle_dorsiflexion = 0.3;
  EXPECT_GT(forward_kinematics(body, pose).joints[Joint::kLeftToe].z(),
            forward_kinematics(body, Pose{}).joints[Joint::kLeftToe].z() + 0.02);
  left = {};
  pose.tilt = 0.3;
  EXPECT_GT(forward_kinematics(body, pose).joints[Joint::kHead].x(), 0.1);
  EXPECT_GT(forward_kinematics(body, pose).joints[Joint::kLeftKnee].x(),
            -0.2);  // the thigh keeps its angle to the pelvis, and therefore leans back
  pose = {};
  pose.heading = kPi / 2;
  EXPECT_GT(forward_kinematics(body, pose).joints[Joint::kLeftToe].y(), 0.1);
  pose = {};
  pose.list = 0.2;
  EXPECT_GT(forward_kinematics(body, pose).joints[Joint::kLeftHip].z(), 0.01);
}

TEST(ForwardKinematics, SegmentLengthsNeverChange) {
  const Body body = test_body();
  Rng rng(1, Purpose::kTest);
  for (int i = 0; i < 200; ++i) {
    const JointPositions j = forward_kinematics(body, random_pose(rng)).joints;
    for (const Side s : {Side::kLeft, Side::kRight}) {
      EXPECT_NEAR((j[hip(s)] - j[knee(s)]).norm(), body.lengths.thigh, 1e-12);
      EXPECT_NEAR((j[knee(s)] - j[ankle(s)]).norm(), body.lengths.shank, 1e-12);
    }
    EXPECT_TRUE(
        (0.5 * (j[Joint::kLeftHip] + j[Joint::kRightHip])).isApprox(j[Joint::kPelvis], 1e-12));
  }
}

TEST(ForwardKinematics, HipsAndShouldersStandApartByTheirWidths) {
  const Body body = make_body(Subject{}, {.head = true, .arms = true});
  Pose pose;
  pose.heading = 0.7;
  pose.tilt = 0.2;
  pose.list = 0.1;
  const JointPositions joints = forward_kinematics(body, pose).joints;
  const auto apart = [&](Joint a, Joint b) { return (joints[a] - joints[b]).norm(); };
  EXPECT_NEAR(apart(Joint::kLeftHip, Joint::kRightHip), body.lengths.hip_width, 1e-12);
  EXPECT_NEAR(apart(Joint::kLeftShoulder, Joint::kRightShoulder), body.lengths.shoulder_width,
              1e-12);
}

TEST(ForwardKinematics, MirroredPosesGiveMirroredJoints) {
  const Body body = test_body();
  Rng rng(2, Purpose::kTest);
  for (int i = 0; i < 200; ++i) {
    const Pose pose = random_pose(rng);
    const JointPositions a = forward_kinematics(body, pose).joints;
    const JointPositions b = forward_kinematics(body, mirrored(pose)).joints;
    for (int k = 0; k < kJointCount; ++k) {
      const Joint joint = static_cast<Joint>(k);
      const Vector3d reflected = a[joint].cwiseProduct(Vector3d(1, -1, 1));
      EXPECT_TRUE(b[mirrored(joint)].isApprox(reflected, 1e-12)) << kJointNames[size_t(k)];
    }
  }
}

// The planar walker's angles are angles from the vertical in the sagittal plane: hip flexion =
// tilt - thigh angle and knee flexion = shank angle - thigh angle must reproduce u(a) exactly.
TEST(ForwardKinematics, EmbedsThePlaneWithoutSignFlips) {
  const Body body = test_body();
  const double tilt = 0.1, thigh = -0.35, shank = 0.2;
  Pose pose;
  pose.tilt = tilt;
  pose.legs[1].hip_flexion = tilt - thigh;
  pose.legs[1].knee_flexion = shank - thigh;
  const JointPositions j = forward_kinematics(body, pose).joints;
  const Vector3d thigh_up = (j[Joint::kRightHip] - j[Joint::kRightKnee]) / body.lengths.thigh;
  const Vector3d shank_up = (j[Joint::kRightKnee] - j[Joint::kRightAnkle]) / body.lengths.shank;
  EXPECT_TRUE(thigh_up.isApprox(Vector3d(std::sin(thigh), 0, std::cos(thigh)), 1e-12));
  EXPECT_TRUE(shank_up.isApprox(Vector3d(std::sin(shank), 0, std::cos(shank)), 1e-12));
}

TEST(SolePitch, InvertsTheTurnAboutTheBallAtAnyDistance) {
  const BodyLengths l = body_lengths(Subject{});
  for (double pitch = -0.3; pitch < 1.0; pitch += 0.1) {
    EXPECT_NEAR(sole_pitch(l, ankle_from_ball(l, pitch)), pitch, 1e-12);
    EXPECT_NEAR(sole_pitch(l, 1.1 * ankle_from_ball(l, pitch)), pitch, 1e-12);
  }
}

TEST(StandOn, PutsTheAnkleWhereTheFootTurnedAboutItsBallHasIt) {
  const Body body = test_body();
  Rng rng(3, Purpose::kTest);
  for (int i = 0; i < 200; ++i) {
    Pose pose = random_pose(rng);
    const Vector3d ball(draw(rng, 3), draw(rng, 3), 0);
    const double pitch = 0.4 + draw(rng, 0.4);
    const Eigen::Vector2d expected = ankle_from_ball(body.lengths, pitch);
    stand_on(body, Side::kRight, ball, expected, pose);
    const Vector3d ankle = forward_kinematics(body, pose).joints[Joint::kRightAnkle];
    EXPECT_NEAR(ankle.z(), expected.y(), 1e-12);
    EXPECT_NEAR((ankle - ball).head<2>().norm(), std::abs(expected.x()), 1e-12);
  }
}

TEST(StandOn, LaysTheSoleAtItsPitchWhenTheLegMovesInItsPlane) {
  const Body body = test_body();
  Rng rng(4, Purpose::kTest);
  for (int i = 0; i < 200; ++i) {
    Pose pose = random_pose(rng);
    pose.list = 0;
    for (LegPose& leg : pose.legs) leg.hip_abduction = leg.hip_rotation = 0;
    const Vector3d ball(draw(rng, 3), draw(rng, 3), 0);
    const double pitch = 0.4 + draw(rng, 0.4);
    stand_on(body, Side::kLeft, ball, ankle_from_ball(body.lengths, pitch), pose);
    const Skeleton skeleton = forward_kinematics(body, pose);
    EXPECT_NEAR(std::asin(-skeleton.axes(Segment::kLeftFoot)(2, 0)), pitch, 1e-9);
    // The joint is above the point of contact by the ball's height and tips over with the foot.
    const Vector3d toe = skeleton.joints[Joint::kLeftToe];
    EXPECT_NEAR((toe.head<2>() - ball.head<2>()).norm(), body.lengths.ball_height * std::sin(pitch),
                1e-9);
    EXPECT_NEAR(toe.z(), body.lengths.ball_height * std::cos(pitch), 1e-9);
  }
}

TEST(PoseParts, FollowTheirSegmentsAndTheGroupsInUse) {
  const Body with = test_body();
  const Body without = make_body(Subject{}, {.head = false, .arms = false});
  EXPECT_EQ(with.parts.size(), without.parts.size() + 2 + 4);
  const PosedParts parts = pose_parts(with, forward_kinematics(with, Pose{}));
  ASSERT_EQ(parts.size(), with.parts.size());
  for (const PosedPart& part : parts) {
    EXPECT_NEAR(part.lateral.dot(part.forward), 0, 1e-12);
    const Vector3d axis = (part.upper - part.lower).normalized();
    EXPECT_NEAR(axis.dot(part.lateral), 0, 1e-12);
    EXPECT_GT(part.at_lower.lateral, 0);
  }
}

}  // namespace
}  // namespace walktrack
