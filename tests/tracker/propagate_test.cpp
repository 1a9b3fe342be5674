#include "tracker/motion/propagate.h"

#include <cmath>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "fixture.h"
#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

// All noise off: only the walk of the prior.
MotionConfig quiet_kneed() {
  MotionConfig config;
  config.phase_jump_rate = 0;
  config.torque_noise_scale = config.phase_noise = config.ball_drift = config.ball_slip =
      config.footfall_sd = 0;
  config.residual_scale = config.yaw_rate_sd = config.start_position_sd = 0;
  config.control_noise = config.aim_drift = 0;
  return config;
}

void silence(WalkerParticle& particle, const MotionContext& context) {
  particle.noise.fill(0);
  apply_noise(context.model, context.scale, particle);
}

TEST(Propagate, WithoutNoiseWalksStraightAtTheSpeedAimedAt) {
  const Walking walking;
  const double dt = 1.0 / 30;
  const MotionContext context = walking.context(dt, quiet_kneed());
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  p.aim = {1.2, 0.68};
  constexpr int kFrames = 150;
  const Eigen::Vector3d start = p.pose.root;
  for (int frame = 0; frame < kFrames; ++frame) {
    Rng rng(1, Purpose::kTest, static_cast<uint32_t>(frame));
    ASSERT_EQ(propagate(context, p, rng), Outcome::kAlive) << "frame " << frame;
    EXPECT_EQ(p.continuation, Continuation::kSimulated);
    silence(p, context);
  }
  const double distance = p.pose.root.x() - start.x();
  // The gait is the prior's nearest to that aim, to some per cent.
  EXPECT_NEAR(distance / (kFrames * dt), 1.2, 0.06);
  // The heading follows the pelvis, which sways over the supporting foot.
  const double sway = rad_from_deg(1.5);
  EXPECT_NEAR(p.residual[kHeading], 0, sway);
  EXPECT_NEAR(p.pose.root.y() - start.y(), 0, sway * distance);
}

// Law of similarity: with lengths times k and times times root k, a person k times as tall walks in
// the same way, including all noise except that of the angles.
TEST(ToScale, TheSmallAndTheLargeWalkAlike) {
  const auto where = [&](double height) -> Eigen::Vector2d {
    const double length = height / kAdultHeight, dt = kDt * std::sqrt(length);
    Walking walking;
    const Subject subject{.height = height, .mass = 70 * std::pow(length, 3), .lengths = {}};
    walking.model.body = make_body(subject, {.head = true, .arms = false});
    walking.model.walker = kneed_model(kneed_parameters(subject, kStandardGravity));
    walking.moves = make_motion_model(MotionKind::kKneed, walking.model, walking.prior);
    MotionConfig adult;
    adult.phase_jump_rate = 0;  // its acceptance depends on the residuals, whose processes are not
                                // scaled in time
    const MotionContext context = walking.context(dt, to_scale(adult, height));
    WalkerParticle p = walkers(context, 1.3 * std::sqrt(length), 1)[0];
    for (uint32_t frame = 0; frame < 40; ++frame) {
      Rng rng(1, Purpose::kTest, frame);
      EXPECT_EQ(propagate(context, p, rng), Outcome::kAlive);
      std::fill(p.noise.begin() + kResidualNoise, p.noise.end(), 0.0);
      apply_noise(context.model, context.scale, p);
    }
    return p.ball / length;
  };
  // Rounding grows through three logarithms.
  EXPECT_NEAR((where(0.9) - where(kAdultHeight)).norm(), 0, 1e-6);
  EXPECT_NEAR((where(3) - where(kAdultHeight)).norm(), 0, 1e-6);
}

// A walker that images keep moving sideways, as a figure that faces one direction and walks in
// another.
double heading_after(double facing, double aside, double seconds) {
  const Walking walking;
  constexpr double dt = 1.0 / 30;
  MotionConfig config = quiet_kneed();
  config.heading_time_constant = facing;
  const MotionContext context = walking.context(dt, config);
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  const double speed = p.aim.speed;
  Rng rng(1, Purpose::kTest);
  draw_first_noise(context, p, rng);
  for (int frame = 0; frame * dt < seconds; ++frame) {
    EXPECT_EQ(propagate(context, p, rng), Outcome::kAlive);
    silence(p, context);
    // From the place in the last frame, along the path.
    const double way = aside * std::clamp(frame * dt / 0.5, 0.0, 1.0);
    const Eigen::Vector2d place =
        p.pose_before.root.head<2>() + speed * dt * Eigen::Vector2d(std::cos(way), std::sin(way));
    const Eigen::Vector2d shift = place - p.pose.root.head<2>();
    p.ball += shift;
    p.pose.root.head<2>() += shift;
  }
  return p.residual[kHeading];
}

TEST(Propagate, TheHeadingComesBackToTheWay) {
  const double aside = rad_from_deg(20);
  EXPECT_NEAR(heading_after(0.2, aside, 4), aside, rad_from_deg(1));
  EXPECT_NEAR(heading_after(0.2, -aside, 4), -aside, rad_from_deg(1));
  EXPECT_NEAR(heading_after(1000, aside, 4), 0, rad_from_deg(1));
}

// A steady turn is not slowed down: the direction of travel turns with it.
TEST(Propagate, ATurnGoesOn) {
  const Walking walking;
  constexpr double dt = 1.0 / 30, rate = 0.5;
  const MotionContext context = walking.context(dt, quiet_kneed());
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  Rng rng(1, Purpose::kTest);
  draw_first_noise(context, p, rng);
  for (int frame = 0; frame < 90; ++frame) {
    p.residual_before[kHeading] = p.residual[kHeading] - rate * dt;
    ASSERT_EQ(propagate(context, p, rng), Outcome::kAlive);
    silence(p, context);
  }
  const double momentum = context.markov[kHeading].momentum;
  EXPECT_NEAR(p.residual[kHeading], 90 * momentum * rate * dt, 0.1 * 90 * rate * dt);
}

// People's pelvis moves at nearly constant speed, while the walker's slows down over its supporting
// leg and accelerates from foot to foot; but neither a strike nor the roll of the foot makes it
// jump.
TEST(Propagate, ThePelvisNeverJumps) {
  const Walking walking;
  constexpr double dt = 1.0 / 60;
  const MotionContext context = walking.context(dt, quiet_kneed());
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  for (int frame = 0; frame < 300; ++frame) {
    Rng rng(1, Purpose::kTest, static_cast<uint32_t>(frame));
    const Eigen::Vector3d before = p.pose.root;
    ASSERT_EQ(propagate(context, p, rng), Outcome::kAlive);
    silence(p, context);
    EXPECT_NEAR((p.pose.root - before).x() / dt, 1.2, 0.7) << "frame " << frame;
    EXPECT_NEAR((p.pose.root - before).z() / dt, 0, 0.8) << "frame " << frame;
  }
}

// A walker that is bent too far for any step continues upright, in its intended gait.
TEST(Propagate, AWalkerThatFallsContinuesUpright) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30, quiet_kneed());
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  const double upright = p.pose.root.z();
  p.walker.q[kStanceThigh] -= 0.9;
  p.walker.q[kStanceShank] += 0.9;
  Rng rng(1, Purpose::kTest);
  ASSERT_EQ(propagate(context, p, rng), Outcome::kFallen);
  EXPECT_EQ(p.continuation, Continuation::kCaught);
  silence(p, context);
  EXPECT_NEAR(p.pose.root.z(), upright, 0.06);  // the hip's vertical motion within a step
  for (uint32_t frame = 1; frame < 60; ++frame) {
    ASSERT_EQ(propagate(context, p, rng), Outcome::kAlive) << "frame " << frame;
    silence(p, context);
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

TEST(NoiseScale, GrowsAsDiffusionDoes) {
  const Walking walking;
  const NoiseScale slow = walking.context(0.2).scale, fast = walking.context(0.05).scale;
  EXPECT_NEAR(slow.impulse[0] / fast.impulse[0], 2, 1e-12);
}

// The recurrence in motion.h, simulated separately: the process has the stated spread.
TEST(NoiseScale, MarkovProcessesKeepTheirSpreadAtAnyFrameRate) {
  const Walking walking;
  const MarkovConstants c = row_of(kList).process;
  for (const double dt : {1.0 / 7, 1.0 / 30, 1.0 / 240}) {
    const double sigma = walking.context(dt).scale.residual[kList];
    const double r = std::exp(-dt / c.time);
    Rng rng(3, Purpose::kTest);
    double now = c.rest, before = c.rest, squares = 0;
    constexpr int kFrames = 400000;
    for (int frame = 0; frame < kFrames; ++frame) {
      const double next =
          now + r * r * (now - before) + (1 - r) * (1 - r) * (c.rest - now) + sigma * rng.normal();
      before = now;
      now = next;
      squares += (now - c.rest) * (now - c.rest);
    }
    // At 240 frames/s the run holds some 5000 independent values: 5 of their standard errors.
    EXPECT_NEAR(std::sqrt(squares / kFrames) / c.spread, 1, 0.05) << "dt " << dt;
  }
}

// Residual angles change the person's pose without an effect on the walker's gait.
TEST(ApplyNoise, ResidualsMoveThePersonAndNotTheWalker) {
  const Walking walking;
  const MotionContext context = walking.context(1.0 / 30);
  WalkerParticle p = walkers(context, 1.2, 1)[0];
  silence(p, context);
  const KneedState walker = p.walker;
  const double knee = p.pose.legs[0].knee_flexion;
  p.noise[int{kResidualNoise} + kShank] = 2;
  apply_noise(context.model, context.scale, p);
  EXPECT_EQ(p.walker.q, walker.q);
  EXPECT_EQ(p.walker.qd, walker.qd);
  EXPECT_NEAR(p.pose.legs[0].knee_flexion - knee, 2 * context.scale.residual[kShank], 1e-12);
}

}  // namespace
}  // namespace walktrack
