// Published walkers, row by row: fixed points, periods, speeds and Floquet multipliers. The tables
// count angles counter-clockwise with forward to the right, so that every angle and rate changes
// sign.
#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "tests/walker/find_gait.h"
#include "tests/walker/goswami.h"
#include "walker/linkage/linkage_walker.h"
#include "walker/linkage/models.h"
#include "walker/monopode.h"

namespace walktrack {
namespace {

using Eigen::VectorXd;
using std::complex;

VectorXd vector(std::initializer_list<double> values) {
  VectorXd v(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), v.begin());
  return v;
}

// Time is in units of sqrt(l / g), about a second: RK4 at 4e-3 has errors of 1e-10.
GaitOptions options() {
  GaitOptions result;
  result.simulation.max_step = 4e-3;
  return result;
}

// The guess is wrong by a few parts in a thousand, so that Newton's method has to converge.
GaitCycle gait_near(const Walker& walker, const VectorXd& guess) {
  VectorXd off = guess;
  for (Eigen::Index i = guess.size() / 2; i < guess.size(); ++i) off(i) *= 1.002;
  const auto gait = find_gait(walker, off, options());
  if (!gait) throw std::runtime_error("no cycle found");
  return *gait;
}

void expect_multipliers(const GaitCycle& gait, std::initializer_list<complex<double>> expected) {
  Eigen::Index i = 0;
  for (const complex<double>& value : expected) {
    ASSERT_LT(i, gait.cycle.multipliers.size());
    EXPECT_NEAR(gait.cycle.multipliers(i).real(), value.real(), 1e-3);
    EXPECT_NEAR(std::abs(gait.cycle.multipliers(i).imag()), std::abs(value.imag()), 1e-3);
    ++i;
  }
}

void expect_relative(double value, double expected, double tolerance = 1e-6) {
  EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

// Garcia's limit: a hip infinitely heavier than point feet. Masses of 1e-10 give errors of 1e-10.
StraightLeggedParameters garcia(double slope) {
  StraightLeggedParameters p;
  p.slope = slope;
  p.hip_mass = 1;
  p.leg_mass = 1e-10;
  p.leg_inertia = 0;
  p.hip_to_arc = 1;
  p.com_below_hip = 1;
  p.foot_radius = 0;
  return p;
}

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

MonopodeParameters runner(double attack_deg) {
  MonopodeParameters p;
  p.attack = rad_from_deg(attack_deg);
  return p;
}

// The guess determines the energy (given with five digits), which Newton's method keeps.
GaitCycle running_at(const Monopode& walker, double apex) {
  return find_gait(walker, walker.apex(apex, 0, 1784.8).value()).value();
}

TEST(Published, MonopodeRunning) {
  const GaitCycle gait = running_at(Monopode(runner(68)), .95);
  expect_relative(gait.start.q(1), .940267, 1e-4);
  expect_relative(gait.start.qd(0), 5.11585, 1e-4);
  EXPECT_NEAR(gait.cycle.multipliers(0).real(), -.1613, 1e-4);
  const GaitCycle steeper = running_at(Monopode(runner(67)), .95);
  expect_relative(steeper.start.q(1), .959569, 1e-4);
  EXPECT_NEAR(steeper.cycle.multipliers(0).real(), .4414, 1e-4);
}

// Times of landings and take-offs, and the largest forces, along one step.
struct LegRecord {
  double peak = 0, peak_together = 0;  // N, vertical
  std::vector<double> landings, take_offs;
};

LegRecord leg_record(const Walker& walker, const WalkerState& start, int steps) {
  LegRecord record;
  WalkerState state = start;
  std::vector<WalkerEvent> events;
  for (int i = 0; i < steps; ++i) {
    advance(walker, state, 10, {}, events, [&](const WalkerState& now) {
      double together = 0;
      for (const ContactForce& contact : walker.contact_forces(now)) {
        record.peak = std::max(record.peak, contact.force.y());
        together += contact.force.y();
      }
      record.peak_together = std::max(record.peak_together, together);
    });
  }
  for (const WalkerEvent& event : events) {
    if (event.transition.kind == EventKind::kStrike) record.landings.push_back(event.time);
    if (event.transition.kind == EventKind::kTakeOff) record.take_offs.push_back(event.time);
  }
  return record;
}

TEST(Published, MonopodeRunningContact) {
  const Monopode walker(runner(68));
  const auto gait = find_gait(walker, *walker.apex(.9403, 0, 1784.8));
  ASSERT_TRUE(gait);
  const LegRecord legs = leg_record(walker, gait->start, 1);
  ASSERT_EQ(legs.landings.size(), 1u);
  expect_relative(legs.take_offs[0] - legs.landings[0], .14924, 1e-3);
  expect_relative(legs.peak / walker.weight(), 2.659, 1e-3);
}

TEST(Published, MonopodeWalking) {
  MonopodeParameters p;
  p.walks = true;
  p.attack = rad_from_deg(69);
  p.stiffness = 17.8 * p.mass * p.gravity / p.leg_length;
  const Monopode walker(p);
  const double energy = 1.04 * walker.weight() * p.leg_length;
  const auto gait = find_gait(walker, *walker.apex(.9712, 0, energy));
  ASSERT_TRUE(gait);
  expect_relative(gait->start.q(1), .971160, 1e-3);
  expect_relative(gait->start.qd(0), 1.09791, 1e-3);
  expect_relative(gait->step.period, .44402, 1e-3);
  expect_relative(gait->step.step_length, .51384, 1e-3);
  expect_relative(gait->speed, 1.15724, 1e-3);
  expect_multipliers(*gait, {{.8050, .5463}, {.8050, -.5463}});
  const LegRecord legs = leg_record(walker, gait->start, 2);
  expect_relative(legs.take_offs[0] - legs.landings[0], .16690, 1e-3);
  expect_relative(legs.peak / walker.weight(), 1.0497, 1e-3);
  expect_relative(legs.peak_together / walker.weight(), 1.873, 1e-3);
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
  const auto gait = find_gait(walker, guess, options());
  ASSERT_TRUE(gait);
  EXPECT_LT(gait->cycle.residual, 1e-10);
  if (row.parameters.toe_off_impulse == 0) {
    std::vector<double> kinetic;  // the last two are before and after the strike
    WalkerState state = gait->start;
    std::vector<WalkerEvent> events;
    advance(walker, state, 10, options().simulation, events,
            [&](const WalkerState& now) { kinetic.push_back(walker.energy(now).kinetic); });
    const double taken = *(kinetic.end() - 2) - kinetic.back();
    const double given = walker.weight() * gait->step.travel * std::sin(row.parameters.slope);
    EXPECT_NEAR(taken, given, 1e-8 * walker.weight());
  }
  const LinkageWalker large(straight_legged(scaled(row.parameters)));
  GaitOptions slower = options();
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
