#include "tracker/motion/models/markov_motion.h"

#include <cmath>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "fixture.h"
#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

// A walk without noise.
MotionConfig quiet_markov() {
  MotionConfig config;
  config.model = MotionKind::kMarkov;
  config.markov_noise_scale = config.yaw_rate_sd = config.start_position_sd = 0;
  return config;
}

WalkerParticle first_seen(const MotionContext& context, double speed) {
  WalkerParticle p = walkers(context, speed, 1)[0];
  Rng rng(1, Purpose::kTest);
  EXPECT_EQ(draw_first_noise(context, p, rng), Outcome::kAlive);
  silence(context, p);
  return p;
}

// Correlations of x_k and x_0 for the process x_k = p1 x_(k-1) + p2 x_(k-2) + noise.
double correlation(const MarkovStep& step, int lag) {
  const double p1 = 1 + step.momentum - step.pull, p2 = -step.momentum;
  double before = 1, now = p1 / (1 - p2);
  for (int k = 1; k < lag; ++k) {
    const double next = p1 * now + p2 * before;
    before = now;
    now = next;
  }
  return now;
}

// Variance of the same process for noise of variance 1.
double variance(const MarkovStep& step) {
  const double p1 = 1 + step.momentum - step.pull, p2 = -step.momentum;
  return (1 - p2) / ((1 + p2) * ((1 - p2) * (1 - p2) - p1 * p1));
}

TEST(MarkovMotion, ProcessesKeepTheirSpreadAtAnyFrameRate) {
  const Walking walking(MotionKind::kMarkov);
  for (const double dt : {1.0 / 7, 1.0 / 30, 1.0 / 240}) {
    const MotionContext context = walking.context(dt);
    for (size_t k = kList; k < kShoulder; ++k) {
      const MarkovConstants c = context.moves.constants({}, static_cast<ResidualAngle>(k));
      EXPECT_NEAR(context.scale.residual[k] * std::sqrt(variance(context.markov[k])), c.spread,
                  1e-9 * c.spread)
          << "residual " << k << ", dt " << dt;
    }
  }
}

// Changes within a frame are lost, so that faster processes differ slightly more; those of legs and
// root last for many frames.
TEST(MarkovMotion, ProcessesForgetAsFastAtAnyFrameRate) {
  const Walking walking(MotionKind::kMarkov);
  const auto slow = markov_steps(*walking.moves, {}, 1.0 / 30),
             fast = markov_steps(*walking.moves, {}, 1.0 / 300);
  for (const ResidualAngle residual : {kHipFlexion, kKneeFlexion, kRootHeight})
    for (const int lag : {3, 9, 15})
      EXPECT_NEAR(correlation(slow[residual], lag), correlation(fast[residual], 10 * lag), 0.02)
          << "residual " << residual << ", lag " << lag;
}

// After half a period an oscillator is at the same distance on the other side of its rest.
TEST(MarkovMotion, AnglesSwing) {
  const Walking walking(MotionKind::kMarkov);
  const MarkovConstants hip = free_constants(kHipFlexion);
  constexpr double kFine = 1e-3;
  const auto steps = markov_steps(*walking.moves, {}, kFine);
  const int half = static_cast<int>(std::lround(hip.period / 2 / kFine));
  // The process's own damping in half a period; the phase of its correlation lags by a few degrees.
  EXPECT_NEAR(correlation(steps[kHipFlexion], half), -std::exp(-hip.period / 2 / hip.time), 0.02);
}

TEST(MarkovMotion, WithoutNoiseTheRootGoesStraightOnAtItsSpeed) {
  const Walking walking(MotionKind::kMarkov);
  const MotionContext context = walking.context(kDt, quiet_markov());
  WalkerParticle p = first_seen(context, 1.2);
  const Eigen::Vector3d start = p.pose.root;
  constexpr int kFrames = 60;
  for (uint32_t frame = 0; frame < kFrames; ++frame) {
    Rng rng(1, Purpose::kTest, frame);
    ASSERT_EQ(propagate(context, p, rng), Outcome::kAlive);
    silence(context, p);
  }
  EXPECT_NEAR((p.pose.root - start).x() / (kFrames * kDt), p.aim.speed, 1e-9);
  EXPECT_NEAR(p.pose.root.y(), start.y(), 1e-9);
}

// A particle that starts in a gait continues in it, although it has no walker.
TEST(MarkovMotion, EntersAGaitOnTheWay) {
  const Walking walking(MotionKind::kMarkov);
  const MotionContext context = walking.context(kDt, quiet_markov());
  const BodyModel& model = walking.model;
  for (const double phase : {0.01, 0.3, 0.6, 0.99}) {
    WalkerParticle p;
    p.aim = {1.25, 0.7};
    context.moves.initialise(context, std::vector{phase}, {&p, 1});
    const PriorGait gait = gait_at(walking.prior, model.walker.parameters, 1.25, 0.7);
    const Pose now = pose_in_gait(model, gait, p.stance, phase);
    for (size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(p.residual[kKneeFlexion + i], now.legs[i].knee_flexion);
      EXPECT_EQ(p.residual[kHipFlexion + i], now.legs[i].hip_flexion);
      // Knees bend at up to 8 rad/s; a rate that does not fit the neighbouring frames is not that
      // of a gait.
      EXPECT_LT(std::abs(p.residual[kKneeFlexion + i] - p.residual_before[kKneeFlexion + i]),
                8 * kDt);
    }
    EXPECT_EQ(p.residual[kRootHeight], now.root.z());
  }
}

// Feet that move backwards under the root are supporting feet: in the walker's own gait that is the
// stance foot.
TEST(MarkovMotion, TheSupportingFootMovesBackwards) {
  const Walking walking(MotionKind::kMarkov);
  const MotionContext context = walking.context(kDt, quiet_markov());
  const PriorGait gait = gait_at(walking.prior, walking.model.walker.parameters, 1.25, 0.7);
  int right = 0, moments = 0;
  for (double phase = 0.1; phase < 0.9; phase += 0.1, ++moments) {
    WalkerParticle p;
    p.pose = pose_in_gait(walking.model, gait, Side::kRight, phase);
    p.pose_before = pose_in_gait(walking.model, gait, Side::kRight, phase - kDt / gait.period);
    Rng rng(1, Purpose::kTest);
    propagate(context, p, rng);
    right += p.stance == Side::kRight;
  }
  EXPECT_EQ(right, moments);
}

}  // namespace
}  // namespace walktrack
