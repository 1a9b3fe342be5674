// Published walkers, row by row: fixed points, periods, speeds and Floquet multipliers. The tables
// count angles counter-clockwise with forward to the right, so that every angle and rate changes
// sign.
#include <algorithm>
#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "published_gait.h"
#include "tests/walker/goswami.h"
#include "walker/linkage/linkage_walker.h"
#include "walker/linkage/models.h"

namespace walktrack {
namespace {

using Eigen::VectorXd;
using std::complex;

// (theta, swing leg) and rates after impact; phi = theta - psi = 2 theta, and phi_dot follows from
// the impact map: the guess takes the swing leg's rate from it.
VectorXd garcia_guess(double theta, double theta_rate) {
  const double phi_rate = (1 - std::cos(2 * theta)) * theta_rate;
  return vector({-theta, theta, -theta_rate, -(theta_rate - phi_rate)});
}

struct GarciaRow {
  double slope, theta, theta_rate, period;
  complex<double> first, second;
};

class Garcia : public testing::TestWithParam<GarciaRow> {};

TEST_P(Garcia, SimplestWalker) {
  const GarciaRow& row = GetParam();
  const LinkageWalker walker(straight_legged(garcia(row.slope)));
  const GaitCycle gait = gait_near(walker, garcia_guess(row.theta, row.theta_rate));
  expect_relative(-gait.start.q(0), row.theta);
  expect_relative(-gait.start.qd(0), row.theta_rate);
  expect_relative(gait.step.period, row.period);
  expect_multipliers(gait, {row.first, row.second});
}

INSTANTIATE_TEST_SUITE_P(
    Published, Garcia,
    testing::Values(
        GarciaRow{.004, .153389565, -.156080147, 3.8526135, {.22889, .59116}, {.22889, -.59116}},
        GarciaRow{.009, .200310901, -.199832473, 3.8824638, {-.19010, .55760}, {-.19010, -.55760}},
        GarciaRow{.009, .193937370, -.203866927, 3.0961059, {4.00386, 0}, {.45959, 0}},
        GarciaRow{.015, .236712185, -.231546131, 3.9120039, {-.98046, 0}, {-.30420, 0}}));

// Step angle grows like the cube root of the slope: .3287 on doubly logarithmic paper from .004 to
// .012 (least squares over nine slopes; printed to four digits).
TEST(GarciaFamily, StepAngleGrowsLikeTheCubeRootOfTheSlope) {
  constexpr int kSlopes = 9;
  double x = 0, y = 0, xx = 0, xy = 0, theta = .153389565, theta_rate = -.156080147;
  for (int k = 0; k < kSlopes; ++k) {
    const double slope = .004 + .001 * k;
    const LinkageWalker walker(straight_legged(garcia(slope)));
    const GaitCycle gait = gait_near(walker, garcia_guess(theta, theta_rate));
    theta = -gait.start.q(0);
    theta_rate = -gait.start.qd(0);
    const double u = std::log(slope), v = std::log(theta);
    x += u, y += v, xx += u * u, xy += u * v;
  }
  EXPECT_NEAR((kSlopes * xy - x * y) / (kSlopes * xx - x * x), .3287, 5e-4);
}

// Gaits of one step are stable up to .0151; there a multiplier leaves the unit circle through -1,
// and gaits of two steps begin.
TEST(GarciaFamily, LosesItsStabilityByPeriodDoublingAtTheSlopePrinted) {
  const auto first_multiplier = [](double slope) {
    const LinkageWalker walker(straight_legged(garcia(slope)));
    return gait_near(walker, garcia_guess(.2367, -.2315)).cycle.multipliers(0);
  };
  for (const auto& [slope, stable] : {std::pair{.0150, true}, std::pair{.0152, false}}) {
    const complex<double> first = first_multiplier(slope);
    EXPECT_NEAR(first.imag(), 0, 1e-9);
    EXPECT_LT(first.real(), 0);
    EXPECT_EQ(std::abs(first) < 1, stable) << slope;
  }
}

struct StraightRow {
  const char* name;
  StraightLeggedParameters parameters;
  double theta, theta_rate, swing_rate, period;
  std::vector<complex<double>> multipliers;
};

void expect_straight(const StraightRow& row) {
  const LinkageWalker walker(straight_legged(row.parameters));
  const GaitCycle gait =
      gait_near(walker, vector({-row.theta, row.theta, -row.theta_rate, -row.swing_rate}));
  expect_relative(-gait.start.q(0), row.theta);
  expect_relative(-gait.start.qd(0), row.theta_rate);
  expect_relative(-gait.start.qd(1), row.swing_rate);
  expect_relative(gait.step.period, row.period);
  for (size_t i = 0; i < row.multipliers.size(); ++i) {
    const auto found = gait.cycle.multipliers(static_cast<Eigen::Index>(i));
    EXPECT_NEAR(found.real(), row.multipliers[i].real(), 1e-3) << row.name;
    EXPECT_NEAR(std::abs(found.imag()), std::abs(row.multipliers[i].imag()), 1e-3) << row.name;
  }
}

TEST(Published, GoswamiCompassGait) {
  expect_straight({"Goswami",
                   goswami(),
                   .271028680,
                   -1.092383590,
                   -.377373949,
                   .7343464,
                   {{-.19973, .54448}, {-.19973, -.54448}, {.13157, 0}}});
}

TEST(Published, McGeerRoundFeet) {
  const StraightLeggedParameters mcgeer{.gravity = 1,
                                        .slope = .03,
                                        .hip_mass = 0,
                                        .leg_mass = 1,
                                        .leg_inertia = .32 * .32,
                                        .hip_to_arc = .7,
                                        .com_below_hip = .37,
                                        .foot_radius = .3};
  expect_straight({"McGeer",
                   mcgeer,
                   .308435440,
                   -.403104114,
                   -.280688281,
                   2.6363655,
                   {{.43164, 0}, {-.15292, .29860}, {-.15292, -.29860}}});
}

// The frequently copied fixed point .189472782 uses the relative spin at heel strike, which is
// wrong for I > 0.
TEST(Published, RoundFeetWithInertia) {
  const StraightLeggedParameters round{.gravity = 1,
                                       .slope = .01,
                                       .hip_mass = 1,
                                       .leg_mass = .5,
                                       .leg_inertia = .02,
                                       .hip_to_arc = 1,
                                       .com_below_hip = .5,
                                       .foot_radius = .2};
  expect_straight({"round feet", round, .189438283, -.239010988, -.187613981, 2.4279558, {}});
}

struct KuoRow {
  double slope, stiffness, impulse;
  double theta, theta_rate, swing_rate, period, speed, largest;
};

class Kuo : public testing::TestWithParam<KuoRow> {};

TEST_P(Kuo, AnthropomorphicWalker) {
  const KuoRow& row = GetParam();
  StraightLeggedParameters p;  // the defaults are Kuo's numbers
  p.leg_inertia = .16 * .326 * .326;
  p.slope = row.slope;
  p.hip_stiffness = row.stiffness;
  p.toe_off_impulse = row.impulse;
  expect_straight({"Kuo", p, row.theta, row.theta_rate, row.swing_rate, row.period, {}});
  const LinkageWalker walker(straight_legged(p));
  const GaitCycle gait =
      gait_near(walker, vector({-row.theta, row.theta, -row.theta_rate, -row.swing_rate}));
  EXPECT_NEAR(gait.speed, row.speed, 1e-5 * row.speed);  // six printed digits
  EXPECT_NEAR(gait.cycle.largest_multiplier(), row.largest, 1e-3);
  EXPECT_EQ(gait.cycle.is_stable(), row.largest < 1);
}

INSTANTIATE_TEST_SUITE_P(
    Published, Kuo,
    testing::Values(
        KuoRow{.010, 0, 0, .257733705, -.268578556, -.219948074, 2.9150077, .175466, .3940},
        KuoRow{0, 0, .06, .309104598, -.334156693, -.267997464, 2.9158701, .209663, .5284},
        KuoRow{0, .10, .10, .335708232, -.512001304, -.393117244, 1.5744242, .420876, .9253},
        KuoRow{0, .05, .10, .357459851, -.479461382, -.355249490, 1.8990592, .370884, 1.3052}));

// Kuo 2002: Garcia's walker on level ground, driven by an impulse along the trailing leg and a
// spring on the swing leg (with stiffness per mass of the leg).
TEST(Published, SimplestPoweredWalker) {
  StraightLeggedParameters p = garcia(0);
  p.hip_stiffness = 2.5127 * p.leg_mass;
  p.toe_off_impulse = .1877;
  const LinkageWalker walker(straight_legged(p));
  const GaitCycle gait = gait_near(walker, garcia_guess(.355459547, -.505619297));
  expect_relative(-gait.start.q(0), .355459547);
  expect_relative(-gait.start.qd(0), -.505619297);
  expect_relative(gait.step.period, 1.7402695);
  expect_relative(gait.speed, .399962, 2e-6);
  expect_relative(1 / gait.step.period, .574624, 2e-6);
}

// Closed form: eta = (cos 2a + r^2) / (1 + r^2), omega+ = eta omega-,
// omega-^2 - omega+^2 = 2 [cos(slope - a) - cos(slope + a)] / (1 + r^2), multiplier of omega^2
// eta^2.
void expect_rimless(const RimlessWheelParameters& p) {
  const LinkageWalker walker(rimless_wheel(p));
  const double a = p.half_angle, r2 = p.gyration * p.gyration / (p.spoke * p.spoke);
  const double eta = (std::cos(2 * a) + r2) / (1 + r2);
  const double gain =
      2 * p.gravity / p.spoke * (std::cos(p.slope - a) - std::cos(p.slope + a)) / (1 + r2);
  const double before = std::sqrt(gain / (1 - eta * eta));
  const GaitCycle gait = gait_near(walker, vector({-a, 1.1 * eta * before}));
  expect_relative(gait.start.qd(0), eta * before, 1e-9);
  // d omega+ / d omega+ of the previous step; that of omega^2 is the same number at a fixed point.
  expect_multipliers(gait, {eta * eta});
}

TEST(Published, RimlessWheel) {
  RimlessWheelParameters p;
  expect_rimless(p);
  const LinkageWalker walker(rimless_wheel(p));
  const GaitCycle gait = gait_near(walker, vector({-p.half_angle, .349754}));
  EXPECT_NEAR(gait.start.qd(0), .349754, 1e-6);
  EXPECT_NEAR(gait.start.qd(0) / std::cos(2 * p.half_angle), .494627, 1e-6);
  EXPECT_NEAR(gait.cycle.multipliers(0).real(), .5, 1e-6);
  expect_rimless({.gravity = 9.81,
                  .slope = .15,
                  .mass = 3,
                  .spoke = .6,
                  .half_angle = kPi / 10,
                  .gyration = .25});
}

// Hsu Chen 2007: knees latched at their stops, released at the strike. Point mass at the hip: no
// torso angle, q = (stance thigh, swing thigh, stance shank, swing shank).
TEST(Published, PassiveWalkerWithKnees) {
  KneedParameters p;
  p.gravity = 9.81;
  p.slope = .0504;
  p.thigh_length = .5;
  p.shank_length = .5;
  p.torso.mass = .5;
  p.thigh = {.mass = .5, .com_below_hip = .325, .inertia = 0};
  p.shank = {.mass = .05, .com_above_ankle = .375, .com_forward = 0, .inertia = 0};
  const LinkageWalker walker(kneed(p, {}, {.latched = true, .may_fly = false}));
  const double theta = .23859, theta_rate = -1.10959, swing_rate = -.05715;
  const GaitCycle gait = gait_near(walker, vector({-theta, theta, -theta, theta, -theta_rate,
                                                   -swing_rate, -theta_rate, -swing_rate}));
  EXPECT_NEAR(-gait.start.q(0), theta, 1e-4);
  EXPECT_NEAR(-gait.start.qd(0), theta_rate, 1e-4);
  EXPECT_NEAR(-gait.start.qd(1), swing_rate, 1e-4);
  EXPECT_NEAR(gait.step.period, .5643, 1e-4);
  EXPECT_NEAR(gait.cycle.largest_multiplier(), .655, 1e-3);
  double flexion = 0;
  WalkerState state = gait.start;
  std::vector<WalkerEvent> events;
  advance(walker, state, 5, {}, events,
          [&](const WalkerState& now) { flexion = std::max(flexion, now.q(3) - now.q(1)); });
  EXPECT_NEAR(deg_from_rad(flexion), 30, 2);  // "about 30 degrees"
}

}  // namespace
}  // namespace walktrack
