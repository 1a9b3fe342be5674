#include "tracker/particle.h"

#include <cmath>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "fixture.h"

namespace walktrack {
namespace {

// The plane embeds into 3-D: seen from the side, the drawn legs have the walker's own angles.
TEST(PoseOf, HasTheWalkersAnglesInItsPlane) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  for (const WalkerParticle& p : walkers(context, 1.2, 50)) {
    Extras extra{};
    extra[kHeading] = 0.7;
    const Pose pose = pose_of(walking.model, p.walker, Side::kLeft, {2, 3}, extra);
    const JointPositions j = forward_kinematics(walking.model.body, pose).joints;
    const Eigen::Vector3d ahead(std::cos(0.7), std::sin(0.7), 0);
    const auto angle = [&](const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
      const Eigen::Vector3d along = upper - lower;
      return std::atan2(along.dot(ahead), along.z());
    };
    EXPECT_NEAR(angle(j[Joint::kLeftKnee], j[Joint::kLeftHip]), p.walker.q[kStanceThigh], 1e-9);
    EXPECT_NEAR(angle(j[Joint::kLeftAnkle], j[Joint::kLeftKnee]), p.walker.q[kStanceShank], 1e-9);
    EXPECT_NEAR(angle(j[Joint::kRightKnee], j[Joint::kRightHip]), p.walker.q[kSwingThigh], 1e-9);
    EXPECT_NEAR(angle(j[Joint::kRightAnkle], j[Joint::kRightKnee]), p.walker.q[kSwingShank], 1e-9);
    EXPECT_NEAR(angle(j[Joint::kPelvis], j[Joint::kNeck]), p.walker.q[kTorso], 1e-9);
  }
}

TEST(PoseOf, TheStandingFootKeepsItsBallThroughTheStep) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  const double ball_height = walking.model.body.lengths.ball_height;
  for (const WalkerParticle& p : walkers(context, 1.2, 50)) {
    const Pose pose = pose_of(walking.model, p.walker, Side::kLeft, {2, 3}, Extras{});
    const Eigen::Vector3d toe =
        forward_kinematics(walking.model.body, pose).joints[Joint::kLeftToe];
    // The joint lies a ball's height above the contact and tips over with the foot at most so far.
    EXPECT_NEAR(toe.x(), 2, ball_height);
    EXPECT_GE(toe.z(), 0);
    EXPECT_LE(toe.z(), ball_height + 1e-9);
  }
}

TEST(Realise, WithoutNoiseIsThePrediction) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  p.noise.fill(0);
  p.predicted_extra = p.extra;
  realise(walking.model, context.scale, p);
  EXPECT_EQ(p.walker.q, p.predicted.q);
  EXPECT_EQ(p.ball, p.predicted_ball);
  EXPECT_EQ(p.extra, p.predicted_extra);
}

TEST(Realise, KneesNeverBendBackwards) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  Rng rng(3, Purpose::kTest);
  for (int i = 0; i < 500; ++i) {
    for (double& z : p.noise) z = 20 * rng.normal();
    realise(walking.model, context.scale, p);
    for (const LegPose& leg : p.pose.legs) EXPECT_GE(leg.knee_flexion, 0);
  }
}

TEST(InPlane, ASlopePullsAlongTheHeading) {
  Walking walking;
  walking.model.downhill = {0.5, 0};
  EXPECT_NEAR(in_plane(walking.model, 0).gravity.x(), 0.5, 1e-12);
  EXPECT_NEAR(in_plane(walking.model, kPi).gravity.x(), -0.5, 1e-12);
  EXPECT_NEAR(in_plane(walking.model, kPi / 2).gravity.x(), 0, 1e-12);
}

}  // namespace
}  // namespace walktrack
