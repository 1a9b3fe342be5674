#include "tracker/state/particle.h"

#include <cmath>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "fixture.h"

namespace walktrack {
namespace {

// The plane embedded in 3-D: seen from the side, the legs have the angles of the walker.
TEST(PoseOf, HasTheWalkersAnglesInItsPlane) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  for (const WalkerParticle& p : walkers(context, 1.2, 50)) {
    ResidualAngles residual{};
    residual[kHeading] = 0.7;
    const Pose pose = pose_of(walking.model, p.walker, Side::kLeft, p.aim, {2, 3}, residual);
    const KneedState shown = shown_state(p.walker, Side::kLeft, p.aim, residual);
    const JointPositions j = forward_kinematics(walking.model.body, pose).joints;
    const Eigen::Vector3d ahead(std::cos(0.7), std::sin(0.7), 0);
    const auto angle = [&](const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
      const Eigen::Vector3d along = upper - lower;
      return std::atan2(along.dot(ahead), along.z());
    };
    EXPECT_NEAR(angle(j[Joint::kLeftKnee], j[Joint::kLeftHip]), shown.q[kStanceThigh], 1e-9);
    EXPECT_NEAR(angle(j[Joint::kLeftAnkle], j[Joint::kLeftKnee]), shown.q[kStanceShank], 1e-9);
    EXPECT_NEAR(angle(j[Joint::kRightKnee], j[Joint::kRightHip]), shown.q[kSwingThigh], 1e-9);
    EXPECT_NEAR(angle(j[Joint::kRightAnkle], j[Joint::kRightKnee]), shown.q[kSwingShank], 1e-9);
    EXPECT_NEAR(angle(j[Joint::kPelvis], j[Joint::kNeck]), shown.q[kTorso], 1e-9);
  }
}

TEST(PoseOf, TheStandingFootKeepsItsBallThroughTheStep) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  const double ball_height = walking.model.body.lengths.ball_height;
  for (const WalkerParticle& p : walkers(context, 1.2, 50)) {
    const Pose pose =
        pose_of(walking.model, p.walker, Side::kLeft, p.aim, {2, 3}, ResidualAngles{});
    const Eigen::Vector3d toe =
        forward_kinematics(walking.model.body, pose).joints[Joint::kLeftToe];
    // The joint is a ball's height above the contact, tips over with the foot, and moves as the
    // round foot rolls: a centimetre or two.
    EXPECT_NEAR(toe.x(), 2, ball_height + 0.02);
    EXPECT_NEAR(toe.z(), ball_height, 0.02);
  }
}

// The foot that lands is at the place of its ankle in the pose before: the pelvis moves
// continuously, for either foot.
TEST(LandingBall, IsThePlaceTheLandedAnkleHasRolledFrom) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  for (const WalkerParticle& p : walkers(context, 1.2, 20)) {
    const double shank = p.walker.q[kStanceShank];
    const Eigen::Vector2d ball = landing_ball(walking.model, p.pose, p.stance, shank);
    EXPECT_LT((ball - p.ball).norm(), 1e-9);
  }
}

TEST(RolledAnkle, IsTheFlatFootsUnderAnUprightShankAndRisesWithItsLean) {
  const BodyModel model = test_model();
  const BodyLengths& l = model.body.lengths;
  EXPECT_LT((rolled_ankle(model, 0) - ankle_from_ball(l, 0)).norm(), 1e-12);
  // Moves like the walker's own ankle over its arc, computed independently.
  KneedState state;
  for (const double shank : {-0.3, 0.2, 0.6}) {
    state.q.setZero();
    const Eigen::Vector2d upright = kneed_posture(model.walker, state).stance_ankle;
    state.q[kStanceShank] = state.q[kStanceThigh] = shank;
    const Eigen::Vector2d leaning = kneed_posture(model.walker, state).stance_ankle;
    EXPECT_LT((rolled_ankle(model, shank) - rolled_ankle(model, 0) - (leaning - upright)).norm(),
              1e-12);
  }
}

TEST(ApplyNoise, WithoutNoiseIsThePrediction) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  p.noise.fill(0);
  p.predicted_residual = p.residual;
  apply_noise(walking.model, context.scale, p);
  EXPECT_EQ(p.walker.q, p.predicted.q);
  EXPECT_EQ(p.ball, p.predicted_ball);
  EXPECT_EQ(p.residual, p.predicted_residual);
}

TEST(ApplyNoise, KneesNeverBendBackwards) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  Rng rng(3, Purpose::kTest);
  for (int i = 0; i < 500; ++i) {
    for (double& z : p.noise) z = 20 * rng.normal();
    apply_noise(walking.model, context.scale, p);
    for (const LegPose& leg : p.pose.legs) EXPECT_GE(leg.knee_flexion, 0);
  }
}

TEST(ApplyNoise, KneesBendNoFurtherThanTheHeelCanComeToTheThigh) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  for (const int shank : {kStanceShank, kSwingShank}) p.predicted.q[shank] += 4;
  apply_noise(walking.model, context.scale, p);
  for (const LegPose& leg : p.pose.legs) EXPECT_NEAR(leg.knee_flexion, rad_from_deg(150), 1e-12);
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
