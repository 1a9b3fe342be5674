#include "gait/walk_plan.h"

#include <cmath>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

const WalkPlan kFaster{.speed = 1, .changes = {{1, 1.4}}, .acceleration = 0.3};

class WalkPlans : public testing::Test {
 protected:
  GaitPrior prior = load_gait_prior();
  KneedParameters adult = adult_walker(1.75, 70);
  PlanProgress progress;
};

TEST_F(WalkPlans, SayWhichSpeedIsWantedWhen) {
  const WalkPlan plan{.speed = 1, .changes = {{2, 1.6}, {3, 0.7}}};
  EXPECT_EQ(planned_speed(plan, 0), 1);
  EXPECT_EQ(planned_speed(plan, 2), 1);
  EXPECT_EQ(planned_speed(plan, 2.5), 1.6);
  EXPECT_EQ(planned_speed(plan, 9), 0.7);
}

TEST_F(WalkPlans, AWalkerThatKeepsUpIsLedOnAtTheAcceleration) {
  const PriorGait first = first_gait(prior, adult, kFaster, 0, progress);
  EXPECT_NEAR(first.speed, 1, 1e-12);
  PriorGait gait = next_gait(prior, adult, kFaster, 0.8, first.start, progress);
  EXPECT_NEAR(gait.speed, 1, 1e-12);  // before the change
  gait = next_gait(prior, adult, kFaster, 1.3, first.start, progress);
  EXPECT_NEAR(gait.speed, 1 + 0.5 * 0.3, 1e-9);
}

TEST_F(WalkPlans, AWalkerThatLagsIsSlowedDownOnceItHasSettled) {
  const WalkPlan slower{.speed = 1, .changes = {{1, 0.7}}, .acceleration = 0.3};
  KneedState lagging = first_gait(prior, adult, slower, 0, progress).start;
  lagging.qd[kTorso] += 1;  // a third of the unit of rates
  EXPECT_NEAR(next_gait(prior, adult, slower, 1.5, lagging, progress).speed, 1, 1e-12);
  // The second time it is the same: it will come no closer.
  EXPECT_NEAR(next_gait(prior, adult, slower, 2, lagging, progress).speed, 1 - 0.5 * 0.3, 1e-9);
}

TEST_F(WalkPlans, AWalkerThatLagsMaySpeedUp) {
  KneedState lagging = first_gait(prior, adult, kFaster, 0, progress).start;
  lagging.qd[kTorso] += 1;
  EXPECT_NEAR(next_gait(prior, adult, kFaster, 1.5, lagging, progress).speed, 1.4, 1e-12);
}

TEST_F(WalkPlans, AskForThePreferredStepUnlessOneIsNamed) {
  const PriorGait slow = first_gait(prior, adult, {.speed = 1, .changes = {}}, 0, progress);
  const PriorGait fast = first_gait(prior, adult, {.speed = 1.4, .changes = {}}, 0, progress);
  EXPECT_NEAR(fast.step_length / slow.step_length, std::pow(1.4, 0.42), 1e-9);
  const PriorGait named =
      first_gait(prior, adult, {.speed = 1.2, .changes = {}, .step_length = 0.65}, 0, progress);
  EXPECT_NEAR(named.step_length, 0.65, 1e-12);
}

TEST_F(WalkPlans, TheTableHoldsWalkingSpeeds) {
  const SpeedRange range = speed_range(prior, walker_units(adult));
  EXPECT_NEAR(range.least, 0.5, 0.01);
  EXPECT_NEAR(range.most, 2.2, 0.01);
}

}  // namespace
}  // namespace walktrack
