#include "tracker/motion/stride.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "fixture.h"

namespace walktrack {
namespace {

TEST(LegDifference, IsPeriodicAndSmooth) {
  for (double phase = 0; phase < 1; phase += 0.013) {
    const LegDifference here = leg_difference(phase), later = leg_difference(phase + 3);
    EXPECT_NEAR(here.thigh, later.thigh, 1e-12);
    EXPECT_NEAR(here.shank, later.shank, 1e-12);
    // Slopes are continuous: differences of both sides agree to second order.
    constexpr double h = 1e-5;
    const double ahead = leg_difference(phase + h).shank - here.shank;
    const double behind = here.shank - leg_difference(phase - h).shank;
    EXPECT_NEAR(ahead, behind, 1e-6) << phase;
  }
}

// A person's knee according to the textbook: nearly straight at the strike, flexed by some 15 to 20
// degrees when it takes the load, straight in late stance and flexed by 60 to 70 in swing (Perry &
// Burnfield 2010, ch. 5). The walker's own knee lacks the second and the last.
TEST(LegDifference, MakesTheWalkersKneeAPersons) {
  const Walking walking;
  const double leg = leg_length(walking.model.body.lengths);
  const PriorGait gait = gait_at(walking.prior, walking.model.walker.parameters, 1.3, 0.79 * leg);
  ResidualAngles residual{};
  const auto knee_deg = [&](double stride_phase) {
    const bool stands = stride_phase < 0.5;
    const double step_phase = 2 * (stands ? stride_phase : stride_phase - 0.5);
    const KneedState state = state_at_phase(walking.model.walker, gait, step_phase);
    const KneedState shown =
        shown_state(state, Side::kLeft, {gait.speed, gait.step_length}, residual);
    return deg_from_rad(stands ? shown.q[kStanceShank] - shown.q[kStanceThigh]
                               : shown.q[kSwingShank] - shown.q[kSwingThigh]);
  };
  EXPECT_NEAR(knee_deg(0.01), 5, 5);
  EXPECT_NEAR(knee_deg(0.15), 18, 4);
  EXPECT_LT(knee_deg(0.40), 10);
  EXPECT_NEAR(knee_deg(0.72), 65, 6);
  EXPECT_LT(knee_deg(0.96), 10);
}

}  // namespace
}  // namespace walktrack
