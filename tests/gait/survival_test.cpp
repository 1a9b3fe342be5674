#include "gait/survival.h"

#include <gtest/gtest.h>

namespace walktrack {
namespace {

// Shares of 300 sampled walkers at 1.3 m/s; the limits are the required ones, the one without
// feedback is that of a published table of this walker's cycles at 1.2 m/s.
TEST(Survival, SampledWalkersKeepWalking) {
  const GaitPrior prior = load_gait_prior();
  const KneedParameters adult = adult_walker(1.75, 70);
  SurvivalTrial trial;
  trial.speed = 1.3;
  trial.walkers = 300;
  const auto steadied = survival(prior, adult, trial, {1, 5}, 2);
  EXPECT_GE(steadied[0], 0.95);
  EXPECT_GE(steadied[1], 0.80);
  trial.feedback = 0;
  trial.noise.torque = 0;
  const auto open = survival(prior, adult, trial, {1, 2, 5}, 2);
  EXPECT_GE(open[0], 0.97);
  EXPECT_GE(open[1], 0.71);
  EXPECT_GE(open[2], 0.15);
  EXPECT_LE(open[2], steadied[1]);
}

TEST(Survival, DoesNotDependOnThreadsAndFallsWithNoise) {
  const GaitPrior prior = load_gait_prior();
  const KneedParameters adult = adult_walker(1.6, 55);
  SurvivalTrial trial;
  trial.walkers = 100;
  trial.noise = {.relative = 0.3, .rest = 0.15, .torque = 0.002};
  const auto one = survival(prior, adult, trial, {0.5, 1, 2}, 1);
  EXPECT_EQ(one, survival(prior, adult, trial, {0.5, 1, 2}, 3));
  EXPECT_GE(one[0], one[1]);
  EXPECT_GE(one[1], one[2]);
  EXPECT_LT(one[2], 1);
}

}  // namespace
}  // namespace walktrack
