#include "gait/prior/straight_prior.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gait/prior/build_straight_prior.h"
#include "gait/survival.h"
#include "walker/linkage/linkage_walker.h"
#include "walker/simulate.h"

namespace walktrack {
namespace {

StraightLeggedParameters adult_on(double slope) { return adult_straight_walker(1.75, 70, slope); }

class StraightPriorTest : public testing::Test {
 protected:
  StraightPrior prior = load_straight_prior();
  StraightLeggedParameters adult = adult_on(0);

  StraightGait preferred(double speed, double slope = 0) const {
    const WalkerUnits units = walker_units(adult);
    return gait_at(prior, adult_on(slope), speed,
                   units.length * preferred_step_length(speed / units.speed()));
  }
};

TEST_F(StraightPriorTest, ValidNodesAreStableCyclesThatNeitherBrakeNorPull) {
  size_t valid = 0, level = 0;
  for (size_t i = 0; i < prior.speeds.size(); ++i)
    for (size_t j = 0; j < prior.ratios.size(); ++j)
      for (size_t k = 0; k < prior.slopes.size(); ++k) {
        const StraightNode& node = prior.node(i, j, k);
        const GaitTarget target = prior.target(i, j, k);
        const StraightModel model = straight_unit_model(target.slope);
        const auto step = straight_step(model, node.gait);
        ASSERT_TRUE(step && node.cyclic);
        EXPECT_LT(cycle_residual(node.gait, *step, target).norm(), 1e-6);
        if (!node.valid) continue;
        ++valid;
        level += target.slope == 0;
        EXPECT_GE(node.gait.head<2>().minCoeff(), 0);
        EXPECT_GT(step->least_normal, 0);
        EXPECT_LT(largest_multiplier(*cycle_jacobian(model, node.gait)), 1);
      }
  EXPECT_EQ(valid, 217u);  // of 385: see lib/gait/reports/straight_gaits.md
  EXPECT_EQ(level, 67u);   // of 77
}

// The whole table is computed again: it is the result of this code, on this machine as on others.
TEST_F(StraightPriorTest, IsWhatTheBuilderFinds) {
  const StraightPrior built = build_straight_prior({});
  ASSERT_EQ(built.nodes.size(), prior.nodes.size());
  for (size_t i = 0; i < built.nodes.size(); ++i) {
    EXPECT_EQ(built.nodes[i].valid, prior.nodes[i].valid) << i;
    // Newton's 1e-9, amplified by Jacobians down to 0.007 where the two families meet.
    EXPECT_LT((built.nodes[i].gait - prior.nodes[i].gait).norm(), 1e-6) << i;
  }
}

// The general implementation, without batches and tables, walks the gaits.
TEST_F(StraightPriorTest, GaitsBetweenNodesWalkAtWhatWasAsked) {
  for (const double slope : {0.0, 0.03})
    for (const double speed : {1.2, 1.64, 2.1}) {
      const StraightGait gait = preferred(speed, slope);
      EXPECT_TRUE(gait.valid);
      EXPECT_NEAR(gait.speed, speed, 1e-12);
      StraightLeggedParameters p = adult_on(slope);
      p.hip_stiffness = gait.controls.stiffness;
      p.toe_off_impulse = gait.controls.toe_off_impulse;
      const LinkageWalker walker(straight_legged(p));
      WalkerState state = walker.section_state(gait.start.q, gait.start.qd);
      constexpr int kSteps = 12;
      double advance = 0;
      for (int i = 0; i < kSteps; ++i) {
        const auto step = take_step(walker, state, {.max_step = 0.005}, 3);
        ASSERT_TRUE(step) << speed;
        advance += step->travel;
        state = step->end;
      }
      // Between nodes a gait is slightly wrong.
      EXPECT_NEAR(advance / state.time, speed, 0.03 * speed);
      EXPECT_NEAR(advance / kSteps, gait.step_length, 0.03 * gait.step_length);
    }
}

// Kuo's kuo_level_spring, from which the table was continued: stiffness .1, impulse .1.
TEST_F(StraightPriorTest, HoldsThePublishedCycle) {
  const StraightGait gait = gait_at(prior, {.gravity = 1}, 0.420875681, 0.420875681 * 1.5744242);
  EXPECT_NEAR(gait.controls.stiffness, 0.1, 0.002);
  EXPECT_NEAR(gait.controls.toe_off_impulse, 0.1, 0.001);
  EXPECT_NEAR(gait.multiplier, 0.9253, 0.03);
}

// kuo_level_unstable (.05, .1, multiplier 1.305) and the stable cycle of its speed and step.
TEST_F(StraightPriorTest, TakesTheStableOneOfTwoCyclesAtOneSpeedAndStep) {
  const GaitTarget target{0.3708841, 0.3708841 * 1.8990592, 0};
  StraightGaitVector published;
  published << 0.05, 0.1, 0.357459851, 0.479461382, 0.35524949;
  const StraightModel model = straight_unit_model(0);
  const auto step = straight_step(model, published);
  ASSERT_TRUE(step);
  EXPECT_LT(cycle_residual(published, *step, target).norm(), 1e-6);
  EXPECT_NEAR(largest_multiplier(*cycle_jacobian(model, published)), 1.3052, 1e-3);
  EXPECT_FALSE(find_straight_cycle(published, target));
  const StraightGait near = gait_at(prior, {.gravity = 1}, target.speed, target.step_length);
  const auto stable = find_straight_cycle(near.vector, target);
  ASSERT_TRUE(stable);
  EXPECT_NEAR((*stable)[0], 0.0558, 1e-4);
  EXPECT_NEAR((*stable)[1], 0.0997, 1e-4);
  EXPECT_NEAR(largest_multiplier(*cycle_jacobian(model, *stable)), 0.863, 1e-3);
}

TEST_F(StraightPriorTest, RequestsOutsideAreMovedIntoTheValidSet) {
  const StraightGait fast = gait_at(prior, adult, 9, 5), still = gait_at(prior, adult, 0, 0);
  EXPECT_LT(fast.speed, 2.3);
  EXPECT_TRUE(fast.valid && still.valid);
  // Long slow steps would need a spring that drives the legs apart; steps are shortened until it is
  // not needed.
  const StraightGait slow = gait_at(prior, adult, 0.7, 0.75);
  EXPECT_TRUE(slow.valid);
  EXPECT_LT(slow.step_length, 0.72);
  EXPECT_FALSE(preferred(0.6, 0.06).valid);  // downhill, slowly: it would have to brake
}

TEST_F(StraightPriorTest, PhaseRunsFromTransferToTransfer) {
  const StraightGait gait = preferred(1.25);
  const StraightModel model = straight_model(adult);
  EXPECT_EQ(state_at_phase(model, gait, 0).q, gait.start.q);
  const StraightState middle = state_at_phase(model, gait, 0.4);
  EXPECT_NEAR(middle.since_transfer, 0.4 * gait.period, 1e-12);
  EXPECT_LT(middle.q[1], gait.start.q[1]);  // the leg swings forward
  EXPECT_EQ(middle.transfers, 0);
}

TEST_F(StraightPriorTest, FeedbackSteadiesAndIsOffAtStrengthZeroAndAtTheGaitItself) {
  const StraightGait gait = preferred(1.25);
  StraightState off = gait.start;
  off.qd[0] += 0.1;
  EXPECT_EQ(next_controls(gait, off, 0).stiffness, gait.controls.stiffness);
  EXPECT_NEAR(next_controls(gait, gait.start).stiffness, gait.controls.stiffness, 1e-9);
  EXPECT_GT(std::abs(next_controls(gait, off).toe_off_impulse - gait.controls.toe_off_impulse),
            0.1);
  const StraightNode& node = prior.node(9, 3, 0);
  const StraightJacobian jacobian = *cycle_jacobian(straight_unit_model(0), node.gait);
  const StraightStepMatrix closed = step_matrix(jacobian) - jacobian.block<3, 2>(0, 0) * node.gain;
  EXPECT_LT(closed.eigenvalues().cwiseAbs().maxCoeff(), node.multiplier - 0.02);
}

TEST_F(StraightPriorTest, NoisyWalkersKeepWalkingAndMoreSoWithFeedback) {
  const auto alive = [&](double speed, double noise, double feedback) {
    const SurvivalTrial trial{.speed = speed,
                              .noise = {.relative = noise, .torque = 0},
                              .feedback = feedback,
                              .walkers = 256};
    return survival(prior, adult, trial, {10}, 2)[0];
  };
  const double alone = alive(1.3, 0.02, 0), led = alive(1.3, 0.02, 1);
  EXPECT_GT(alone, 0.5);
  EXPECT_GT(led, alone + 0.05);
  EXPECT_GT(alive(0.8, 0.05, 1), 0.99);
}

TEST_F(StraightPriorTest, DrawsAreNeverNegativeAndHaveTheirDensity) {
  const StraightGait gait = preferred(1.3);
  const GaitNoise noise;
  double integral = 0;
  constexpr int kSteps = 2000;
  const double width = 8 * noise.relative / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    StraightControls drawn = gait.controls;
    drawn.stiffness *= 1 - 4 * noise.relative + (i + 0.5) * width;
    integral += std::exp(log_density(drawn, gait.controls, noise)) * width;
  }
  const double peak = 1 / (noise.relative * std::sqrt(2 * 3.141592653589793) * 0.9973002);
  EXPECT_NEAR(integral, peak, 1e-3 * peak);  // the impulse stays at its mean
  for (uint32_t i = 0; i < 200; ++i) {
    Rng rng(5, Purpose::kTest, 0, i);
    const StraightControls mild = draw_controls(rng, gait.controls, noise);
    EXPECT_TRUE(std::isfinite(log_density(mild, gait.controls, noise)));
    const StraightControls wild = draw_controls(rng, gait.controls, {.relative = 3});
    EXPECT_GE(std::min(wild.stiffness, wild.toe_off_impulse), 0);
  }
  Rng rng(6, Purpose::kTest);
  const Vector2 torque = draw_hip_torque(rng, gait.units, noise, 1.0 / 30);
  EXPECT_EQ(torque.sum(), 0);  // one joint between two legs
  EXPECT_NE(torque[0], 0);
}

}  // namespace
}  // namespace walktrack
