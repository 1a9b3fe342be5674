#include "gait/optimal_gait.h"

#include <cmath>

#include <gtest/gtest.h>

#include "gait/prior/gait_prior.h"

namespace walktrack {
namespace {

TEST(OptimalGait, GrowthBoundsTheSpectralRadius) {
  SectionMatrix matrix = SectionMatrix::Zero();
  matrix(0, 0) = 0.8;
  matrix(1, 2) = -0.9;  // a rotating pair of modulus 0.9
  matrix(2, 1) = 0.9;
  EXPECT_GE(growth_per_step(matrix), 0.9);
  EXPECT_LT(growth_per_step(matrix), 0.9 * std::pow(3, 1.0 / 16));
}

TEST(OptimalGait, SearchKeepsTheCycleAndLowersTheObjective) {
  const GaitPrior prior = load_gait_prior();
  const size_t i = prior.speeds.size() / 2, j = prior.ratios.size() / 2,
               k = prior.slopes.size() / 2;
  const GaitTarget target{prior.speeds[i], prior.ratios[j] * preferred_step_length(prior.speeds[i]),
                          prior.slopes[k]};
  const KneedModel model = unit_model(target);
  // Away from the optimum: softer torso, then back onto the cycles.
  GaitVector start = prior.node(i, j, k).gait;
  start[0] *= 0.97;
  start[6] *= 1.03;
  const auto cycle = find_cycle(model, start, target);
  ASSERT_TRUE(cycle);
  const GaitObjective objective;
  GaitSearch search;
  search.rounds = 1;
  search.trials = 40;
  const GaitVector better = optimal_gait(*cycle, target, objective, search);
  EXPECT_LE(objective_value(model, objective, better), objective_value(model, objective, *cycle));
  EXPECT_LT(cycle_residual(better, *step_of(model, better), target).norm(), 1e-8);
}

TEST(OptimalGait, UnwalkableGaitCostsMost) {
  const GaitVector zero = GaitVector::Zero();
  EXPECT_EQ(objective_value(unit_model({}), {}, zero), kUnwalkable);
}

}  // namespace
}  // namespace walktrack
