#include "tracker/motion.h"

#include <cmath>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "fixture.h"

namespace walktrack {
namespace {

// All noise off: the walk of the prior, nothing else.
MotionConfig quiet() {
  MotionConfig config;
  config.torque_noise_scale = config.planar_misfit_deg = config.ball_drift = config.landing = 0;
  config.arrival = config.control_noise = config.aim_drift = 0;
  return config;
}

void silence(WalkerParticle& particle, const MotionContext& context) {
  particle.noise.fill(0);
  realise(context.model, context.scale, particle);
}

TEST(Propagate, WithoutNoiseWalksStraightAtTheSpeedAimedAt) {
  const Walking walking;
  const double dt = 1.0 / 30;
  const MotionContext context = walking.context(dt, quiet());
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  p.aim = {1.2, 0.68};
  constexpr int kFrames = 150;
  const Eigen::Vector3d start = p.pose.root;
  for (int frame = 0; frame < kFrames; ++frame) {
    Rng rng(1, Purpose::kTest, static_cast<uint32_t>(frame));
    ASSERT_EQ(propagate(context, p, rng), Outcome::kAlive) << "frame " << frame;
    silence(p, context);
  }
  const double distance = p.pose.root.x() - start.x();
  // The drawn foot turns about its ball where the walker's foot rolls: up to 3 cm a step are lost.
  EXPECT_NEAR(distance / (kFrames * dt), 1.2, 0.12);
  EXPECT_NEAR(p.extra[kHeading], 0, 1e-9);
}

// A frame's way is at most that of a running person: neither a strike nor the turn of the foot
// makes the drawn pelvis jump.
TEST(Propagate, ThePelvisNeverJumps) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 60, quiet());
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  for (int frame = 0; frame < 300; ++frame) {
    Rng rng(1, Purpose::kTest, static_cast<uint32_t>(frame));
    const Eigen::Vector3d before = p.pose.root;
    ASSERT_EQ(propagate(context, p, rng), Outcome::kAlive);
    silence(p, context);
    EXPECT_LT((p.pose.root - before).norm(), 0.06) << "frame " << frame;
  }
}

TEST(Propagate, MostNoisyWalkersWalkOnForThreeSeconds) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  int alive = 0;
  constexpr int kWalkers = 200;
  for (uint32_t i = 0; i < kWalkers; ++i) {
    WalkerParticle p = walkers(context, 1.2, 1)[0];
    bool walks = true;
    for (uint32_t frame = 0; walks && frame < 90; ++frame) {
      Rng rng(i, Purpose::kTest, frame);
      walks = propagate(context, p, rng) == Outcome::kAlive;
    }
    alive += walks;
  }
  EXPECT_GT(alive, kWalkers / 2);
}

TEST(Perturb, LeavesTheStandardNormalPriorOfTheNoiseInvariant) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  constexpr int kChains = 4000;
  double sum = 0, squares = 0;
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  for (uint32_t i = 0; i < kChains; ++i) {
    Rng rng(i, Purpose::kTest);
    for (double& z : p.noise) z = rng.normal();
    for (int move = 0; move < 5; ++move) perturb(context, 0.5, p, rng);
    sum += p.noise[kPlanarNoise];
    squares += p.noise[kPlanarNoise] * p.noise[kPlanarNoise];
  }
  EXPECT_NEAR(sum / kChains, 0, 5 / std::sqrt(double{kChains}));
  EXPECT_NEAR(squares / kChains, 1, 5 * std::sqrt(2.0 / kChains));
}

TEST(NoiseScale, GrowsAsDiffusionDoes) {
  const Walking walking;
  const NoiseScale slow = noise_scale({}, walking.model, 0.2),
                   fast = noise_scale({}, walking.model, 0.05);
  EXPECT_NEAR(slow.planar / fast.planar, 2, 1e-12);
  EXPECT_NEAR(slow.impulse[0] / fast.impulse[0], 2, 1e-12);
  EXPECT_NEAR(slow.extra[kHeading] / fast.extra[kHeading], 8, 1e-12);
}

}  // namespace
}  // namespace walktrack
