#include "gait/walk_plan.h"

#include <cmath>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

TEST(WalkPlan, SpeedRampsAndHolds) {
  const WalkPlan plan{.speed = 1, .changes = {{2, 1.6}, {3, 0.7}}, .acceleration = 0.3};
  EXPECT_EQ(wanted_speed(plan, 0), 1);
  EXPECT_EQ(wanted_speed(plan, 2), 1);
  EXPECT_NEAR(wanted_speed(plan, 3), 1.3, 1e-15);  // on its way when the next change comes
  EXPECT_NEAR(wanted_speed(plan, 4), 1.0, 1e-15);
  EXPECT_NEAR(wanted_speed(plan, 9), 0.7, 1e-15);
}

TEST(WalkPlan, AsksForThePreferredStepUnlessOneIsNamed) {
  const GaitPrior prior = load_gait_prior();
  const KneedParameters adult = adult_walker(1.75, 70);
  const PriorGait slow = planned_gait(prior, adult, {.speed = 1, .changes = {{1, 1.4}}}, 0);
  const PriorGait fast = planned_gait(prior, adult, {.speed = 1, .changes = {{1, 1.4}}}, 9);
  EXPECT_NEAR(slow.speed, 1, 1e-12);
  EXPECT_NEAR(fast.speed, 1.4, 1e-12);
  EXPECT_NEAR(fast.step_length / slow.step_length, std::pow(1.4, 0.42), 1e-9);
  const PriorGait named =
      planned_gait(prior, adult, {.speed = 1.2, .changes = {}, .step_length = 0.65}, 0);
  EXPECT_NEAR(named.step_length, 0.65, 1e-12);
}

}  // namespace
}  // namespace walktrack
