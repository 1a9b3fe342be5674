#include "gait/prior/gait_prior.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "gait/prior/build_prior.h"

namespace walktrack {
namespace {

class ShippedPrior : public testing::Test {
 protected:
  GaitPrior prior = load_gait_prior();
  KneedParameters adult = adult_walker(1.75, 70);
  KneedModel model = kneed_model(adult);

  // Steps of an interpolated gait without noise, up to `most`.
  struct Walk {
    int steps = 0;
    double speed = 0, step_length = 0;
  };
  Walk walk(const PriorGait& gait, double feedback, int most) const {
    KneedState state = gait.start;
    double time = 0;
    Walk result;
    while (result.steps < most) {
      const auto run =
          kneed_advance(model, next_controls(gait, state, feedback), Vector5::Zero(), state, 3);
      if (run.event != KneedEvent::kTransfer) break;
      time += run.elapsed;
      ++result.steps;
    }
    if (result.steps == 0) return result;
    result.speed = state.contact_x / time;
    result.step_length = state.contact_x / result.steps;
    return result;
  }
  // Twenty steps in frames of 1/240 s, before each of which the state may be rounded to single
  // precision.
  Walk walk_in_frames(const PriorGait& gait, bool rounded) const {
    const auto kept = [&](const Vector5& numbers) -> Vector5 {
      return rounded ? Vector5(numbers.cast<float>().cast<double>()) : numbers;
    };
    KneedState state = gait.start;
    KneedControls controls = next_controls(gait, state, 1);
    double time = 0;
    Walk result;
    while (result.steps < 20) {
      state.q = kept(state.q);
      state.qd = kept(state.qd);
      const auto run = kneed_advance(model, controls, Vector5::Zero(), state, 1.0 / 240);
      time += run.elapsed;
      if (run.event == KneedEvent::kNone) continue;
      if (run.event != KneedEvent::kTransfer) break;
      controls = next_controls(gait, state, 1);
      ++result.steps;
    }
    result.speed = state.contact_x / time;
    result.step_length = state.contact_x / std::max(1, result.steps);
    return result;
  }
};

// Everything that is integrated is kept in double precision. Were it kept in single precision, the
// walker would walk on all the same: rounding neither makes it fall nor changes its gait.
TEST_F(ShippedPrior, RoundingToSinglePrecisionChangesNoGait) {
  for (const double speed : {0.6, 1.0, 1.3, 1.6, 1.8}) {
    const PriorGait gait = gait_at(prior, adult, speed, 0.55 * std::sqrt(speed));
    ASSERT_TRUE(gait.valid) << speed;
    const Walk exact = walk_in_frames(gait, false), rounded = walk_in_frames(gait, true);
    EXPECT_EQ(rounded.steps, 20) << speed;
    EXPECT_NE(rounded.speed, exact.speed) << speed;
    EXPECT_NEAR(rounded.speed, exact.speed, 1e-6) << speed;
    EXPECT_NEAR(rounded.step_length, exact.step_length, 1e-6) << speed;
  }
}

TEST_F(ShippedPrior, ValidNodesAreCyclesWithinTheirLimits) {
  size_t valid = 0, stable = 0;
  for (size_t i = 0; i < prior.speeds.size(); ++i)
    for (size_t j = 0; j < prior.ratios.size(); ++j)
      for (size_t k = 0; k < prior.slopes.size(); ++k) {
        const GaitNode& node = prior.node(i, j, k);
        if (!node.valid) continue;
        ++valid;
        stable += node.multiplier < 0.95;
        const GaitTarget target{prior.speeds[i],
                                prior.ratios[j] * preferred_step_length(prior.speeds[i]),
                                prior.slopes[k]};
        const auto step = step_of(unit_model(target), node.gait);
        ASSERT_TRUE(step);
        EXPECT_LT(cycle_residual(node.gait, *step, target).norm(), 1e-6);
        EXPECT_GE(step->measures.clearance, 0.0107);
        EXPECT_GE(step->measures.swing_flexion, 0.785);
        EXPECT_LE(step->measures.stance_flexion, 0.437);
      }
  EXPECT_GE(valid, prior.nodes.size() * 7 / 10);
  EXPECT_GE(stable, valid * 8 / 10);
}

TEST_F(ShippedPrior, InterpolatedGaitsWalkAtWhatWasAsked) {
  for (const double speed : {0.8, 1.0, 1.17, 1.33, 1.58, 1.83})
    for (const double share : {0.82, 1.0, 1.13}) {
      const double length = 0.9275 * share * preferred_step_length(speed / 3.016);
      const PriorGait gait = gait_at(prior, adult, speed, length);
      EXPECT_NEAR(gait.speed, speed, 1e-12);
      EXPECT_NEAR(gait.step_length, length, 1e-12);
      const Walk w = walk(gait, 1, 30);
      EXPECT_EQ(w.steps, 30) << speed << " m/s, " << length << " m";
      // Between the nodes a gait is slightly wrong; the tracker follows its own state anyway.
      EXPECT_NEAR(w.speed, speed, 0.05 * speed) << length;
      EXPECT_NEAR(w.step_length, length, 0.05 * length) << speed;
    }
}

// A slow walker with short quick steps and one with long slow steps.
TEST_F(ShippedPrior, HoldsUnusualWalkers) {
  const PriorGait quick = gait_at(prior, adult, 0.66, 0.40);
  EXPECT_NEAR(quick.period, 0.40 / 0.66, 1e-9);
  EXPECT_EQ(walk(quick, 1, 10).steps, 10);
  const KneedParameters woman = adult_walker(1.65, 60);
  const PriorGait slow = gait_at(prior, woman, 1.155, 0.727);
  EXPECT_NEAR(slow.period, 0.727 / 1.155, 1e-9);
}

TEST_F(ShippedPrior, RequestsOutsideAreMovedToTheBorder) {
  const PriorGait fast = gait_at(prior, adult, 9, 0.7), still = gait_at(prior, adult, 0, 0);
  EXPECT_LT(fast.speed, 2.5);
  EXPECT_GT(still.speed, 0.4);
  EXPECT_GT(still.step_length, 0.2);
  EXPECT_TRUE(fast.start.q.allFinite() && still.start.q.allFinite());
}

TEST_F(ShippedPrior, PhaseRunsFromTransferToTransfer) {
  const PriorGait gait = gait_at(prior, adult, 1.25, 0.7);
  EXPECT_EQ(state_at_phase(model, gait, 0).q, gait.start.q);
  const KneedState middle = state_at_phase(model, gait, 0.5);
  EXPECT_NEAR(middle.since_transfer, 0.5 * gait.period, 1e-9);
  EXPECT_GT(kneed_swing_foot(model, middle).height, 0);
}

TEST_F(ShippedPrior, FeedbackIsOffAtStrengthZeroAndAtTheGaitItself) {
  const PriorGait gait = gait_at(prior, adult, 1.25, 0.7);
  KneedState off = gait.start;
  off.qd[kStanceThigh] += 0.3;
  EXPECT_EQ(next_controls(gait, off, 0).hip.stiffness, gait.controls.hip.stiffness);
  EXPECT_NEAR(next_controls(gait, gait.start).toe_off_impulse, gait.controls.toe_off_impulse, 1e-9);
  EXPECT_GT(std::abs(next_controls(gait, off).toe_off_impulse - gait.controls.toe_off_impulse),
            1e-3);
}

TEST_F(ShippedPrior, DrawsKeepTheirMeanAndSpreadAndNeverTurnNegative) {
  const PriorGait gait = gait_at(prior, adult, 1.25, 0.7);
  const GaitNoise noise;
  double sum = 0, square = 0;
  constexpr int kDraws = 4000;
  for (uint32_t i = 0; i < kDraws; ++i) {
    Rng rng(5, Purpose::kTest, 0, i);
    const double r =
        draw_controls(rng, gait.controls, noise).hip.stiffness / gait.controls.hip.stiffness - 1;
    sum += r;
    square += r * r;
    Rng wild(5, Purpose::kTest, 1, i);
    const KneedControls c = draw_controls(wild, gait.controls, {.relative = 3, .rest = 1});
    ASSERT_GE(std::min({c.torso.stiffness, c.hip.stiffness, c.stance_knee.stiffness,
                        c.swing_knee.stiffness, c.torso.damping, c.hip.damping,
                        c.stance_knee.damping, c.swing_knee.damping, c.toe_off_impulse}),
              0);
  }
  // 5 sigma of the mean; truncation at 3 sd lowers the spread by 1.3 %.
  EXPECT_NEAR(sum / kDraws, 0, 5 * noise.relative / std::sqrt(kDraws));
  EXPECT_NEAR(std::sqrt(square / kDraws), noise.relative, 0.08 * noise.relative);
}

TEST_F(ShippedPrior, DensityIsTheOneOfTheDraws) {
  const KneedControls mean = gait_at(prior, adult, 1.25, 0.7).controls;
  const GaitNoise noise;
  // Along one coordinate the density integrates to one over its support, the others at their means.
  KneedControls drawn = mean;
  const double at_mean = log_density(mean, mean, noise);
  double integral = 0;
  constexpr int kSteps = 2000;
  const double width = 8 * noise.relative / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    drawn.hip.damping = mean.hip.damping * (1 - 4 * noise.relative + (i + 0.5) * width);
    integral += std::exp(log_density(drawn, mean, noise) - at_mean) * width;
  }
  // exp(at_mean) is the product of 13 peaks, each 1 / (sd sqrt(2 pi) mass within 3 sd).
  const auto peak = [](double sd) {
    return 1 / (sd * std::sqrt(2 * 3.141592653589793) * 0.9973002);
  };
  EXPECT_NEAR(integral * peak(noise.relative), 1, 1e-3);
  EXPECT_NEAR(at_mean, 9 * std::log(peak(noise.relative)) + 4 * std::log(peak(noise.rest)), 1e-5);
  drawn = mean;
  drawn.torso.rest += 3.1 * noise.rest;
  EXPECT_EQ(log_density(drawn, mean, noise), -std::numeric_limits<double>::infinity());
  Rng rng(8, Purpose::kTest);
  for (int i = 0; i < 100; ++i)
    EXPECT_TRUE(std::isfinite(log_density(draw_controls(rng, mean, noise), mean, noise)));
}

TEST_F(ShippedPrior, PassesThroughItsNodesAndIsSmoothBetween) {
  const WalkerUnits units = walker_units(adult);
  const size_t level = prior.slopes.size() / 2;
  const auto at = [&](double speed, double ratio) {
    return gait_at(prior, adult, speed * units.speed(),
                   ratio * preferred_step_length(speed) * units.length);
  };
  const PriorGait node = at(prior.speeds[5], prior.ratios[3]);
  EXPECT_LT((node.vector - prior.node(5, 3, level).gait).norm(), 1e-9);
  // The slope is continuous at a node: differences on both sides agree.
  const double h = 1e-4;
  const GaitVector left = (node.vector - at(prior.speeds[5] - h, prior.ratios[3]).vector) / h;
  const GaitVector right = (at(prior.speeds[5] + h, prior.ratios[3]).vector - node.vector) / h;
  EXPECT_LT((left - right).norm(), 0.01 * (1 + left.norm()));
}

TEST_F(ShippedPrior, TorqueNoiseDiffusesAlikeAtAnyFrameRate) {
  const auto spread = [&](double duration) {
    double square = 0;
    for (uint32_t i = 0; i < 2000; ++i) {
      Rng rng(6, Purpose::kTest, 0, i);
      const double torque = draw_torques(rng, walker_units(adult), {}, duration)[kSwingShank];
      square += torque * torque;
    }
    return std::sqrt(square / 2000);
  };
  EXPECT_NEAR(spread(1.0 / 120) / spread(1.0 / 30), 2, 1e-9);  // the same draws
  Rng rng(6, Purpose::kTest);
  EXPECT_EQ(draw_torques(rng, walker_units(adult), {.torque = 0}, 0.1), Vector5::Zero());
}

// Continuation without the optimisation, which takes a quarter of a minute for each node: the same
// bytes on one thread and on two.
TEST(BuildPrior, DoesNotDependOnThreads) {
  PriorGrid grid;
  grid.speeds = {0.39, 0.4145, 0.44};
  grid.ratios = {1};
  grid.slopes = {0};
  grid.search.rounds = 0;
  grid.sweeps = 0;
  std::vector<size_t> tried;
  const auto keep = [&](const GaitPrior&, size_t count) {
    tried.push_back(count);
    return true;
  };
  const GaitPrior one = build_gait_prior(grid, {}, 1, keep);
  const GaitPrior two = build_gait_prior(grid, {}, 2, keep);
  EXPECT_EQ(tried, (std::vector<size_t>{1, 3, 1, 3}));
  for (size_t i = 0; i < one.nodes.size(); ++i) {
    EXPECT_TRUE(one.nodes[i].cyclic) << i;
    EXPECT_EQ(one.nodes[i].gait, two.nodes[i].gait) << i;
    EXPECT_EQ(one.nodes[i].gain, two.nodes[i].gain) << i;
  }
}

TEST(MeasuredNode, BrokenGaitIsInvalid) {
  EXPECT_FALSE(measured_node(GaitVector::Zero(), {0.4, 0.7}, 1).valid);
}

}  // namespace
}  // namespace walktrack
