// Laws of mechanics that every linkage walker obeys: power, energy, momentum.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "reference_kneed.h"

namespace walktrack {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Along a motion without impacts d(kinetic + gravity)/dt is the power of the joints' torques, and
// the springs and dampers of hip and knees never add to kinetic + gravity + elastic.
TEST(LinkageWalker, PowerBalance) {
  const LinkageWalker walker = reference_walker();
  Rng rng(63, Purpose::kTest);
  for (int i = 0; i < 20; ++i) {
    WalkerState state = same_state(reference().parameters, random_kneed(rng));
    state.active = 0;
    const VectorXd qdd = walker.acceleration(state);
    const double h = 1e-6;
    const auto at = [&](double t) {
      WalkerState moved = state;
      moved.q += t * state.qd + t * t / 2 * qdd;
      moved.qd += t * qdd;
      return walker.energy(moved);
    };
    const WalkerEnergy later = at(h), earlier = at(-h);
    const double rate =
        (later.kinetic + later.gravity - earlier.kinetic - earlier.gravity) / (2 * h);
    const VectorXd powers = walker.actuator_powers(state);
    EXPECT_NEAR(rate, powers.sum(), 1e-5 * (1 + powers.cwiseAbs().sum()));
    // All except the torso's law, the first: elastic energy and dissipation only.
    const double elastic_rate = (later.elastic - earlier.elastic) / (2 * h);
    EXPECT_LE(powers.tail(powers.size() - 1).sum() + elastic_rate, 1e-5 * (1 + std::abs(rate)));
  }
}

LinkageWalker unforced_walker() {
  return LinkageWalker(kneed(reference().parameters, {}, {.may_fly = false}));
}

// Slope of the drift: halving the step divides it by 2 (Euler), 16 (RK4).
TEST(LinkageWalker, UnforcedEnergyDriftsAtTheIntegratorsOrder) {
  const LinkageWalker walker = unforced_walker();
  WalkerState start = same_state(reference().parameters, reference().states[0].state);
  start.active = 0;
  const auto drift = [&](Integrator integrator, double dt) {
    WalkerState state = start;
    std::vector<WalkerEvent> events;
    advance(walker, state, 0.04, {.integrator = integrator, .max_step = dt}, events);
    EXPECT_TRUE(events.empty());
    return std::abs(walker.energy(state).total() - walker.energy(start).total());
  };
  EXPECT_NEAR(std::log2(drift(Integrator::kEuler, 1e-4) / drift(Integrator::kEuler, 5e-5)), 1, .05);
  EXPECT_NEAR(std::log2(drift(Integrator::kRk4, 8e-3) / drift(Integrator::kRk4, 4e-3)), 4, .7);
  EXPECT_LT(drift(Integrator::kMidpoint, 1e-3), drift(Integrator::kEuler, 1e-3) / 100);
}

// An independent sum: every part is two point masses at its radius of gyration along the part, with
// positions written out by hand from the ankle up and from the hip down.
struct PointMass {
  double mass;
  Vector2d position;
};

std::vector<PointMass> point_masses(const KneedParameters& p, const VectorXd& q, double contact) {
  const auto u = [&](Index i) { return Vector2d(std::sin(q(i)), std::cos(q(i))); };
  const auto w = [&](Index i) { return Vector2d(std::cos(q(i)), -std::sin(q(i))); };
  std::vector<PointMass> points;
  const auto add = [&](double mass, double inertia, const Vector2d& com, Index i) {
    const Vector2d gyration = std::sqrt(inertia / mass) * u(i);
    points.push_back({mass / 2, com + gyration});
    points.push_back({mass / 2, com - gyration});
  };
  const Vector2d centre(contact + p.foot_radius * q(3), p.foot_radius);
  const Vector2d ankle1 = centre - p.foot_up * u(3) - p.foot_forward * w(3);
  const Vector2d hip = ankle1 + p.shank_length * u(3) + p.thigh_length * u(1);
  const Vector2d ankle2 = hip - p.thigh_length * u(2) - p.shank_length * u(4);
  const auto shank_com = [&](const Vector2d& ankle, Index i) -> Vector2d {
    return ankle + p.shank.com_above_ankle * u(i) + p.shank.com_forward * w(i);
  };
  add(p.torso.mass, p.torso.inertia, hip + p.torso.com_above_hip * u(0), 0);
  add(p.thigh.mass, p.thigh.inertia, hip - p.thigh.com_below_hip * u(1), 1);
  add(p.thigh.mass, p.thigh.inertia, hip - p.thigh.com_below_hip * u(2), 2);
  add(p.shank.mass, p.shank.inertia, shank_com(ankle1, 3), 3);
  add(p.shank.mass, p.shank.inertia, shank_com(ankle2, 4), 4);
  return points;
}

double angular_momentum_about(const KneedParameters& p, const WalkerState& state,
                              const Vector2d& pivot) {
  const double h = 1e-6, x0 = state.contacts[0];
  const auto later = point_masses(p, state.q + h * state.qd, x0);
  const auto earlier = point_masses(p, state.q - h * state.qd, x0);
  double sum = 0;
  for (size_t i = 0; i < later.size(); ++i) {
    const Vector2d v = (later[i].position - earlier[i].position) / (2 * h);
    const Vector2d r = (later[i].position + earlier[i].position) / 2 - pivot;
    sum += later[i].mass * (r.y() * v.x() - r.x() * v.y());
  }
  return sum;
}

// Without toe-off the impulse acts at the new contact point alone: the angular momentum of the
// whole walker about it is conserved.
TEST(LinkageWalker, StrikeConservesMomentumAboutTheContactAndNeverGainsEnergy) {
  const KneedParameters& p = reference().parameters;
  Linkage linkage = kneed(p, {}, {.may_fly = false});
  linkage.limits.clear();
  const LinkageWalker walker(linkage);
  Rng rng(64, Purpose::kTest);
  for (int i = 0; i < 50; ++i) {
    WalkerState state = same_state(p, random_kneed(rng));
    state.active = 0;
    const Transition strike = walker.strike(state, true);
    const double x = strike.after.contacts[0] + p.foot_radius * strike.after.q(3);
    const double before = angular_momentum_about(p, state, {x, walker.foot_height(state, true)});
    const double after = angular_momentum_about(p, strike.after, {x, 0});
    EXPECT_NEAR(after, before, 1e-6 * (1 + std::abs(before)));  // central differences of 1e-6
    EXPECT_LE(walker.energy(strike.after).kinetic, walker.energy(state).kinetic * (1 + 1e-12));
    const Vector2d jump = walker.momentum(strike.after).linear - walker.momentum(state).linear;
    EXPECT_LT((jump - strike.impulse).norm(), 1e-10 * (1 + jump.norm()));
  }
}

TEST(LinkageWalker, StepImpulseActsAlongAStraightLegWithoutTorque) {
  StraightLeggedParameters p;
  p.toe_off_impulse = 0.1;
  const LinkageWalker driven(straight_legged(p));
  p.toe_off_impulse = 0;
  const LinkageWalker idle(straight_legged(p));
  const VectorXd q = Vector2d(0.3, -0.3), qd = Vector2d(0.5, 0.4);
  WalkerState state = idle.section_state(q, qd);
  const Transition with = driven.strike(state, true), without = idle.strike(state, true);
  const Vector2d extra = driven.momentum(with.after).linear - idle.momentum(without.after).linear;
  // The ground's impulse except for the toe-off is that of the landing foot.
  EXPECT_LT(
      (extra - (with.impulse - without.impulse) - 0.1 * Vector2d(std::sin(0.3), std::cos(0.3)))
          .norm(),
      1e-14);
}

// Kuo's closed form for massless legs: rate+ = cos 2a rate + P sin 2a, and the new swing leg keeps
// rate+ cos 2a. Legs of 1e-10 have an error of that size; rounding of the impulse on them would be
// 1e3 times as large.
TEST(LinkageWalker, ToeOffLeavesLightLegsTheirDigits) {
  const StraightLeggedParameters p{.hip_mass = 1,
                                   .leg_mass = 1e-10,
                                   .leg_inertia = 0,
                                   .hip_to_arc = 1,
                                   .com_below_hip = 1,
                                   .foot_radius = 0,
                                   .toe_off_impulse = .2};
  const LinkageWalker walker(straight_legged(p));
  Rng rng(66, Purpose::kTest);
  for (int i = 0; i < 50; ++i) {
    const double a = .1 + .4 * rng.uniform(), rate = .2 + .6 * rng.uniform();
    const WalkerState state =
        walker.section_state(Vector2d(a, -a), Vector2d(rate, 2 * rng.uniform() - 1));
    const VectorXd after = walker.strike(state, true).after.qd;
    const double expected = std::cos(2 * a) * rate + .2 * std::sin(2 * a);
    EXPECT_NEAR(after(0), expected, 1e-9);
    EXPECT_NEAR(after(1), expected * std::cos(2 * a), 1e-9);
  }
}

TEST(LinkageWalker, AngularMomentumOfAWalkingCycleStaysSmall) {
  // People regulate it (Herr & Popovic 2008: within a few percent of mass x speed x height).
  const CycleFile file = read_kneed_cycles();
  const ReferenceCycle& row = file.cycles[2];
  const LinkageWalker walker(kneed(file.parameters, row.controls, {.may_fly = false}));
  WalkerState state = walker.section_state(row.start.q, row.start.qd);
  double largest = 0, mass = 0;
  std::vector<WalkerEvent> events;
  advance(walker, state, 2, {}, events, [&](const WalkerState& now) {
    const PlanarMomentum m = walker.momentum(now);
    largest = std::max(largest, std::abs(m.angular));
    mass = m.mass;
  });
  EXPECT_GT(largest, 0);
  EXPECT_LT(largest / (mass * 1.0 * 1.75), 0.1);
}

}  // namespace
}  // namespace walktrack
