#include "tracker/motion/models/anthropomorphic_motion.h"

#include <cmath>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "fixture.h"
#include "tests/tracker/frame_time.h"
#include "tracker/motion/models/markov_motion.h"

namespace walktrack {
namespace {

// The walk of the prior, without noise: knees straighten, the trunk becomes upright.
MotionConfig quiet_anthropomorphic() {
  MotionConfig config;
  config.model = MotionKind::kAnthropomorphic;
  config.torque_noise_scale = config.phase_noise = config.ball_drift = config.ball_slip =
      config.footfall_sd = 0;
  config.yaw_rate_sd = config.start_position_sd = config.control_noise = config.aim_drift = 0;
  return config;
}

TEST(AnthropomorphicMotion, WithoutNoiseWalksStraightAtTheSpeedAimedAt) {
  const Walking walking(MotionKind::kAnthropomorphic);
  const MotionContext context = walking.context(kDt, quiet_anthropomorphic());
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  const double speed = p.aim.speed;
  const Eigen::Vector3d start = p.pose.root;
  constexpr int kFrames = 150;
  for (uint32_t frame = 0; frame < kFrames; ++frame) {
    Rng rng(1, Purpose::kTest, frame);
    ASSERT_EQ(propagate(context, p, rng), Outcome::kAlive) << "frame " << frame;
    silence(context, p);
  }
  // The fifth second ends within a step, so that the hip is in front or behind by some centimetres.
  EXPECT_NEAR((p.pose.root - start).x() / (kFrames * kDt), speed, 0.05);
  EXPECT_NEAR(p.pose.root.y(), start.y(), 0.15);  // abduction of the legs moves the hips sideways
  EXPECT_GE(p.walker.transfers, 7);
}

// Between two transfers the foot's place is constant; the hip moves as smoothly as the walker's.
TEST(AnthropomorphicMotion, TheStandingFootStands) {
  const Walking walking(MotionKind::kAnthropomorphic);
  const MotionContext context = walking.context(kDt, quiet_anthropomorphic());
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  for (uint32_t frame = 0; frame < 90; ++frame) {
    const WalkerParticle before = p;
    Rng rng(1, Purpose::kTest, frame);
    propagate(context, p, rng);
    silence(context, p);
    if (p.walker.transfers == before.walker.transfers)
      EXPECT_NEAR((p.ball - before.ball).norm(), 0, 1e-12) << "frame " << frame;
    else
      EXPECT_EQ(p.stance, other(before.stance));
  }
}

TEST(AnthropomorphicMotion, AWalkerThatFallsContinuesUpright) {
  const Walking walking(MotionKind::kAnthropomorphic);
  const MotionContext context = walking.context(kDt, quiet_anthropomorphic());
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  for (const int k : {kStanceThigh, kStanceShank}) p.walker.q[k] = -1.3;
  p.predicted = p.walker;
  silence(context, p);
  const Eigen::Vector3d hips = p.pose.root;
  Rng rng(1, Purpose::kTest);
  ASSERT_EQ(propagate(context, p, rng), Outcome::kFallen);
  silence(context, p);
  EXPECT_LT((p.pose.root - hips).head<2>().norm(), 0.1) << "they jump";
  for (uint32_t frame = 1; frame < 60; ++frame) {
    Rng next(1, Purpose::kTest, frame);
    ASSERT_EQ(propagate(context, p, next), Outcome::kAlive) << "frame " << frame;
    silence(context, p);
  }
}

// Knees bend about the lines of the legs: for any flexion, thigh and shank lean equally to both
// sides.
TEST(AnthropomorphicMotion, KneesBendAboutTheLinesOfTheLegs) {
  const Walking walking(MotionKind::kAnthropomorphic);
  const MotionContext context = walking.context(kDt, quiet_anthropomorphic());
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  p.noise.fill(0);
  for (const double flexion : {0.0, 0.4, 1.1}) {
    p.predicted_residual[kKneeFlexion] = p.predicted_residual[kKneeFlexion + 1] = flexion;
    context.moves.apply_noise(context, p);
    for (size_t i = 0; i < 2; ++i) {
      const bool stands = i == static_cast<size_t>(p.stance);
      const LegPose& leg = p.pose.legs[i];
      const double thigh = p.pose.tilt - leg.hip_flexion, shank = thigh + leg.knee_flexion;
      EXPECT_NEAR(leg.knee_flexion, flexion, 1e-12);
      EXPECT_NEAR((thigh + shank) / 2,
                  p.walker.q[stands ? kStanceThigh : kSwingThigh] + p.residual[kThigh + i], 1e-12);
    }
  }
}

// The state that contains the straight legs stays one of straight legs and of an upright trunk.
TEST(AnthropomorphicMotion, TheWalkerHasNoKneesAndNoTrunk) {
  const Walking walking(MotionKind::kAnthropomorphic);
  const MotionContext context = walking.context(kDt);
  for (WalkerParticle p : walkers_on_their_way(context, 50)) {
    Rng rng(2, Purpose::kTest);
    for (int move = 0; move < 3; ++move) perturb(context, 0.5, p, rng);
    EXPECT_EQ(p.walker.q[kTorso], 0);
    EXPECT_EQ(p.walker.q[kStanceThigh], p.walker.q[kStanceShank]);
    EXPECT_EQ(p.walker.q[kSwingThigh], p.walker.q[kSwingShank]);
  }
}

// Its basin is narrow: three in four noisy walkers stumble within three seconds. But walkers that
// stumble are caught, and continue.
TEST(AnthropomorphicMotion, NoisyWalkersWalkOnAllTheSame) {
  const Walking walking(MotionKind::kAnthropomorphic);
  const MotionContext context = walking.context(kDt);
  constexpr int kWalkers = 100, kFrames = 90;
  double speed = 0;
  for (const WalkerParticle& start : walkers(context, 1.2, kWalkers)) {
    WalkerParticle p = start;
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
      Rng rng(static_cast<uint64_t>(1e6 * start.aim.speed), Purpose::kTest, frame);
      ASSERT_NE(propagate(context, p, rng), Outcome::kDead);
    }
    EXPECT_GT(p.pose.root.z(), 0.7 * leg_length(walking.model.body.lengths));
    speed += (p.pose.root - start.pose.root).head<2>().norm() / (kFrames * kDt) / kWalkers;
  }
  // It cannot be accelerated (lib/gait/reports/straight_gaits.md), so that aims that drift slow it
  // down: by a tenth in this time, and certainly not by a fifth.
  EXPECT_NEAR(speed, 1.2, 0.24);
}

}  // namespace
}  // namespace walktrack
