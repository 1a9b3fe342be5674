// Members of the families of straight-legged walkers of which no numbers were published.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "published_gait.h"
#include "tests/walker/goswami.h"

namespace walktrack {
namespace {

using Eigen::VectorXd;

// Other members of the families, from guesses with one or two digits. Laws for all of them: lengths
// x 2, masses x 3 and gravity x 5 keep angles and multipliers, and multiply rates by sqrt(5 / 2);
// without actuators the strike dissipates the energy from gravity.
struct OtherRow {
  const char* name;
  StraightLeggedParameters parameters;
  double angle, rate, swing_rate;
};

StraightLeggedParameters scaled(StraightLeggedParameters p) {
  p.gravity *= 5;
  p.hip_mass *= 3;
  p.leg_mass *= 3;
  p.leg_inertia *= 3 * 4;
  p.hip_to_arc *= 2;
  p.com_below_hip *= 2;
  p.foot_radius *= 2;
  p.hip_stiffness *= 3 * 2 * 5;                 // m g l
  p.toe_off_impulse *= 3 * std::sqrt(2.0 * 5);  // m sqrt(g l)
  return p;
}

class OtherWalkers : public testing::TestWithParam<OtherRow> {};

TEST_P(OtherWalkers, AreFoundFromCoarseGuessesAndObeyTheirLaws) {
  const OtherRow& row = GetParam();
  const LinkageWalker walker(straight_legged(row.parameters));
  const VectorXd guess = vector({-row.angle, row.angle, row.rate, row.swing_rate});
  const auto gait = find_gait(walker, guess, fine_steps());
  ASSERT_TRUE(gait);
  EXPECT_LT(gait->cycle.residual, 1e-10);
  if (row.parameters.toe_off_impulse == 0) {
    std::vector<double> kinetic;  // the last two are before and after the strike
    WalkerState state = gait->start;
    std::vector<WalkerEvent> events;
    advance(walker, state, 10, fine_steps().simulation, events,
            [&](const WalkerState& now) { kinetic.push_back(walker.energy(now).kinetic); });
    const double taken = *(kinetic.end() - 2) - kinetic.back();
    const double given = walker.weight() * gait->step.travel * std::sin(row.parameters.slope);
    EXPECT_NEAR(taken, given, 1e-8 * walker.weight());
  }
  const LinkageWalker large(straight_legged(scaled(row.parameters)));
  GaitOptions slower = fine_steps();
  const double time = std::sqrt(2.0 / 5);
  slower.simulation.max_step *= time;
  VectorXd start = gait->cycle.point;
  start.tail(2) /= time;
  const auto same = find_gait(large, start, slower);
  ASSERT_TRUE(same);
  EXPECT_LT((same->start.q - gait->start.q).norm(), 1e-8);
  EXPECT_NEAR(same->step.period, time * gait->step.period, 1e-7);
  EXPECT_NEAR(same->cycle.largest_multiplier(), gait->cycle.largest_multiplier(), 1e-5);
}

StraightLeggedParameters kuo_with(double stiffness, double impulse) {
  StraightLeggedParameters p;
  p.hip_stiffness = stiffness;
  p.toe_off_impulse = impulse;
  return p;
}

StraightLeggedParameters mcgeer_with(double radius, double gyration, double slope) {
  return {.gravity = 1,
          .slope = slope,
          .hip_mass = 0,
          .leg_mass = 1,
          .leg_inertia = gyration * gyration,
          .hip_to_arc = 1 - radius,
          .com_below_hip = .37,
          .foot_radius = radius};
}

StraightLeggedParameters compass(double hip_mass, double com_below_hip, double slope_deg) {
  StraightLeggedParameters p = goswami();
  p.hip_mass = hip_mass;
  p.com_below_hip = com_below_hip;
  p.slope = rad_from_deg(slope_deg);
  return p;
}

INSTANTIATE_TEST_SUITE_P(
    Families, OtherWalkers,
    testing::Values(OtherRow{"garcia .001", garcia(.001), .1, .1, .1},
                    OtherRow{"garcia .012", garcia(.012), .23, .23, .23},
                    OtherRow{"garcia .019, unstable", garcia(.019), .25, .25, .21},
                    OtherRow{"compass 1 deg", compass(10, .5, 1), .25, 1, .4},
                    OtherRow{"compass 5 deg", compass(10, .5, 5), .25, 1, .4},
                    OtherRow{"compass, light hip", compass(5, .5, 3), .25, 1, .4},
                    OtherRow{"compass, high legs", compass(10, .4, 3), .25, 1, .4},
                    OtherRow{"mcgeer R .1", mcgeer_with(.1, .32, .02), .25, .4, .25},
                    OtherRow{"mcgeer R .5", mcgeer_with(.5, .3, .02), .3, .35, .3},
                    OtherRow{"kuo .045", kuo_with(0, .045), .3, .35, .3},
                    OtherRow{"kuo .12", kuo_with(0, .12), .3, .35, .3},
                    OtherRow{"kuo .2, .1", kuo_with(.2, .1), .3, .5, .4}),
    [](const auto& row) { return "row" + std::to_string(row.index); });

}  // namespace
}  // namespace walktrack
