#include "tracker/moves/phase_jump.h"

#include <cmath>

#include <gtest/gtest.h>

#include "fixture.h"
#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

Rng stream(uint32_t i) { return {5, Purpose::kTorque, 1, i}; }

MotionConfig with_rephasing(double rate) {
  MotionConfig config;
  config.phase_jump_rate = rate;
  return config;
}

// Walking particles, each of which jumps once if it does so in a hundred attempts; returns their
// number.
template <typename Check>
int rephase_each(const Walking& walking, int count, const Check& check) {
  const StepLibrary steps(walking.model, walking.prior);
  const MotionContext context = walking.context(kDt, with_rephasing(0));
  int accepted = 0;
  uint32_t i = 0;
  for (WalkerParticle& particle : walkers_on_their_way(context, count)) {
    const WalkerParticle before = particle;
    Rng rng = stream(i++);
    bool changed = false;
    for (int attempt = 0; attempt < 100 && !changed; ++attempt)
      changed = try_phase_jump(context, steps, particle, rng);
    if (!changed) continue;
    ++accepted;
    check(context, before, particle);
  }
  return accepted;
}

void expect_same_legs(const Pose& a, const Pose& b, double tolerance) {
  EXPECT_NEAR(a.tilt, b.tilt, tolerance);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(a.legs[i].hip_flexion, b.legs[i].hip_flexion, tolerance);
    EXPECT_NEAR(a.legs[i].knee_flexion, b.legs[i].knee_flexion, tolerance);
  }
}

TEST(PhaseJump, ThePoseStays) {
  const Walking walking;
  int other_leg = 0;
  const int accepted = rephase_each(
      walking, 400,
      [&](const MotionContext& context, const WalkerParticle& before, const WalkerParticle& now) {
        other_leg += now.stance != before.stance;
        const Pose shown =
            pose_of(context.model, now.walker, now.stance, now.aim, now.ball, now.residual);
        expect_same_legs(shown, before.pose, 1e-12);
        EXPECT_LT((shown.root - before.pose.root).head<2>().norm(), 1e-12);
      });
  EXPECT_GT(accepted, 20);
  EXPECT_GT(other_leg, 2);
}

// In the frame that it leads into, and no longer.
TEST(PhaseJump, IsNotedForOneFrame) {
  const Walking walking;
  const MotionContext always = walking.context(kDt, with_rephasing(2 / kDt)),
                      never = walking.context(kDt, with_rephasing(0));
  int jumped = 0;
  uint32_t i = 0;
  for (WalkerParticle& particle : walkers_on_their_way(always, 200)) {
    Rng rng = stream(i++);
    propagate(always, particle, rng);
    jumped += particle.continuation == Continuation::kJumped;
    if (propagate(never, particle, rng) == Outcome::kAlive) {
      EXPECT_EQ(particle.continuation, Continuation::kSimulated);
    }
  }
  EXPECT_GT(jumped, 5);
  EXPECT_LT(jumped, 200);
}

// Gives the particle residuals, now and one frame ago, from their stationary distribution, and the
// pose that they make. It is crouched, so that no knee reaches its limit.
void draw_residuals(const MotionContext& context, WalkerParticle& particle, Rng& rng) {
  particle.residual[kCrouch] = rad_from_deg(40);
  for (size_t k = kTilt; k <= kShankRight; ++k) {
    const MarkovConstants c = row_of(static_cast<ResidualAngle>(k)).process;
    const double r = std::exp(-context.dt / c.time), correlation = 2 * r / (1 + r * r);
    const double sd = context.config.residual_scale * c.spread;
    const double z = rng.truncated_normal(4), other = rng.truncated_normal(4);
    particle.residual[k] = sd * z;
    particle.residual_before[k] =
        sd * (correlation * z + std::sqrt(1 - correlation * correlation) * other);
  }
  particle.pose = pose_of(context.model, particle.walker, particle.stance, particle.aim,
                          particle.ball, particle.residual);
}

// Metropolis-Hastings: the distribution of residuals is kept, of their values and of their change.
TEST(PhaseJump, LeavesTheResidualsDistribution) {
  const Walking walking;
  const StepLibrary steps(walking.model, walking.prior);
  const MotionContext context = walking.context(kDt, with_rephasing(0));
  constexpr int kParticles = 2000;
  int accepted = 0;
  double squares = 0, changes = 0, count = 0;
  for (WalkerParticle& particle : walkers(context, 1.3, kParticles)) {
    Rng rng = stream(static_cast<uint32_t>(count));
    draw_residuals(context, particle, rng);
    for (int repeat = 0; repeat < 20; ++repeat)
      accepted += try_phase_jump(context, steps, particle, rng);
    for (size_t k = kTilt; k <= kShankRight; ++k) {
      const MarkovConstants c = row_of(static_cast<ResidualAngle>(k)).process;
      const double sd = context.config.residual_scale * c.spread, r = std::exp(-kDt / c.time);
      const double change = particle.residual[k] - particle.residual_before[k];
      squares += std::pow(particle.residual[k] / sd, 2);
      changes += std::pow(change / sd * std::sqrt((1 + r * r) / 2) / (1 - r), 2);
      ++count;
    }
  }
  EXPECT_GT(accepted, kParticles / 10);
  const double four_sigma = 4 * std::sqrt(2 / count);
  EXPECT_NEAR(squares / count, 1, four_sigma);
  EXPECT_NEAR(changes / count, 1, four_sigma);
}

// A set whose walkers still swing a leg that has landed finds the new step.
TEST(PhaseJump, FindsAMissedStrike) {
  const Walking walking;
  const StepLibrary steps(walking.model, walking.prior);
  const MotionContext context = walking.context(kDt, with_rephasing(0));
  const KneedModel& model = context.model.walker;
  const PriorGait gait = gait_at(context.prior, model.parameters, 1.3, 0.7);
  constexpr double kIntoTheStep = 0.3;  // of the right foot; the particles believe it is the left's
  int found = 0;
  constexpr uint32_t kParticles = 40;
  for (uint32_t i = 0; i < kParticles; ++i) {
    WalkerParticle particle = walkers(context, 1.3, 1)[0];
    particle.aim = {gait.speed, gait.step_length};
    const auto pose_at = [&](double phase) {
      return pose_of(context.model, state_at_phase(model, gait, phase), Side::kRight, particle.aim,
                     Eigen::Vector2d::Zero(), particle.residual);
    };
    particle.pose = pose_at(kIntoTheStep);
    particle.stance = Side::kLeft;
    particle.walker = state_at_phase(model, gait, 1);
    particle.residual[kThigh] = rad_from_deg(25);  // about the residual that this pose needs
    particle.residual[kThighRight] = rad_from_deg(-25);
    Rng rng = stream(i);
    for (int frame = 0; frame < 60; ++frame) try_phase_jump(context, steps, particle, rng);
    const double phase = particle.walker.since_transfer / particle.aim.duration();
    found += particle.stance == Side::kRight && std::abs(phase - kIntoTheStep) < 0.15;
  }
  EXPECT_GT(found, 35);
}

TEST(PhaseJump, WalkersWithoutResidualAnglesDoNotJump) {
  const Walking walking;
  const StepLibrary steps(walking.model, walking.prior);
  MotionConfig config = with_rephasing(0);
  config.residual_scale = 0;
  const MotionContext context = walking.context(kDt, config);
  for (WalkerParticle& particle : walkers_on_their_way(context, 20)) {
    Rng rng = stream(0);
    EXPECT_FALSE(try_phase_jump(context, steps, particle, rng));
  }
}

}  // namespace
}  // namespace walktrack
