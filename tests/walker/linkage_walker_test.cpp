#include "walker/linkage/linkage_walker.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "tests/mechanics/random_state.h"
#include "tests/simbody/tree.h"
#include "tests/walker/find_gait.h"
#include "tests/walker/goswami.h"
#include "tests/walker/kneed_files.h"
#include "walker/kneed/kneed_advance.h"
#include "walker/linkage/models.h"

namespace walktrack {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

const ReferenceFile& reference() {
  static const ReferenceFile file = read_kneed_reference();
  return file;
}

LinkageWalker reference_walker(double impulse = 0) {
  KneedControls controls = reference().controls;
  controls.toe_off_impulse = impulse;
  return LinkageWalker(kneed(reference().parameters, controls, {.may_fly = false}));
}

// The kernel's state as a WalkerState, with the flags of the knees' stops.
WalkerState same_state(const KneedParameters& p, const KneedState& kneed) {
  WalkerState state;
  state.q = kneed.q;
  state.qd = kneed.qd;
  state.active = (kneed.stance_stop ? 1u : 0u) | (kneed.swing_stop ? 2u : 0u);
  state.contacts = {kneed.contact_x, kneed.contact_x + p.foot_radius * kneed.q(kStanceShank)};
  return state;
}

KneedState random_kneed(Rng& rng) {
  KneedState state;
  state.q = random_vector(rng, 5, 0.5);
  state.qd = random_vector(rng, 5, 3);
  state.contact_x = rng.uniform();
  state.stance_stop = rng.uniform() < 0.3;
  state.swing_stop = rng.uniform() < 0.3;
  return state;
}

// The general TMT assembly against the hand-written kernel: everything both of them compute.
TEST(LinkageWalker, EqualsTheKneedKernel) {
  const KneedParameters& p = reference().parameters;
  const KneedModel kernel = kneed_model(p);
  const LinkageWalker walker = reference_walker();
  Rng rng(61, Purpose::kTest);
  for (int i = 0; i < 200; ++i) {
    const KneedState kneed = random_kneed(rng);
    const WalkerState state = same_state(p, kneed);
    const Matrix5 mass = kneed_mass_matrix(kernel, kneed.q);
    EXPECT_LT((walker.system(state).mass - mass).norm(), 1e-12 * mass.norm());
    const KneedAcceleration theirs =
        kneed_accelerations(kernel, reference().controls, Vector5::Zero(), kneed);
    const LimitedMotion ours = walker.limited_motion(state);
    const double size = 1 + theirs.qdd.norm();
    // Condition number of the mass matrix about 1e2.
    EXPECT_LT((ours.rate - theirs.qdd).norm(), 1e-12 * size);
    for (Index k = 0; k < 2; ++k) {
      EXPECT_NEAR(ours.force(k), theirs.stop_torque[static_cast<size_t>(k)], 1e-12 * size);
    }
    const KneedEnergy energy = kneed_energy(kernel, kneed);
    EXPECT_NEAR(walker.energy(state).kinetic, energy.kinetic, 1e-12 * energy.kinetic);
    EXPECT_NEAR(walker.energy(state).gravity, energy.potential, 1e-12 * 700);
    EXPECT_LT(
        (walker.contact_forces(state)[0].force - kneed_contact_force(kernel, kneed, theirs.qdd))
            .norm(),
        1e-12 * 100 * size);
    const SwingFoot foot = kneed_swing_foot(kernel, kneed);
    EXPECT_NEAR(walker.foot_height(state, true), foot.height, 1e-14);
    EXPECT_NEAR(walker.swing_lead(state), foot.lead, 1e-14);
  }
}

TEST(LinkageWalker, SupportTransferEqualsTheKneedKernel) {
  const KneedParameters& p = reference().parameters;
  const KneedModel kernel = kneed_model(p);
  Rng rng(62, Purpose::kTest);
  for (int i = 0; i < 100; ++i) {
    KneedState kneed = random_kneed(rng);
    // Both knees are flexed, so that no stop is active on either side.
    kneed.q(kStanceShank) = kneed.q(kStanceThigh) + 0.1;
    kneed.q(kSwingShank) = kneed.q(kSwingThigh) + 0.2;
    kneed.stance_stop = kneed.swing_stop = false;
    const double impulse = 30 * rng.uniform();
    const KneedTransfer theirs = kneed_support_transfer(kernel, impulse, kneed);
    const Transition ours = reference_walker(impulse).strike(same_state(p, kneed), true);
    EXPECT_LT((ours.after.q - theirs.state.q).norm(), 1e-14);
    EXPECT_LT((ours.after.qd - theirs.state.qd).norm(), 1e-11 * (1 + theirs.state.qd.norm()));
    EXPECT_LT((ours.impulse - theirs.impulse).norm(), 1e-10 * (1 + theirs.impulse.norm()));
    EXPECT_NEAR(ours.after.contacts[0], theirs.state.contact_x, 1e-13);
  }
}

TEST(LinkageWalker, ReproducesTheReferenceStates) {
  const KneedParameters& p = reference().parameters;
  for (const ReferenceState& row : reference().states) {
    const WalkerState state = same_state(p, row.state);
    WalkerState free = state;
    free.active = 0;
    const LinkageWalker walker = reference_walker();
    EXPECT_LT((walker.system(state).mass - row.mass_matrix).norm(), 1e-9 * row.mass_matrix.norm());
    EXPECT_LT((walker.acceleration(free) - row.qdd_free).norm(), 1e-9 * row.qdd_free.norm());
    const WalkerEnergy energy = walker.energy(state);
    EXPECT_NEAR(energy.kinetic + energy.gravity, row.energy, 1e-9 * row.energy);
    if (row.qdd_limited) {
      const LimitedMotion limited = walker.limited_motion(state);
      EXPECT_LT((limited.rate - *row.qdd_limited).norm(), 1e-9 * row.qdd_limited->norm());
      EXPECT_NEAR(limited.force(0), row.limit_torque(0), 1e-9 * row.limit_torque.norm());
      EXPECT_NEAR(limited.force(1), row.limit_torque(1), 1e-9 * row.limit_torque.norm());
    }
    // The file's map does not include the knees' stops; they are free here.
    Linkage unlimited = kneed(p, reference().controls, {});
    unlimited.limits.clear();
    for (const double impulse : {0.0, 20.0}) {
      unlimited.toe_off_impulse = impulse;
      const KneedState& expected = impulse > 0 ? row.strike_impulse_20 : row.strike_impulse_0;
      unlimited.may_fly = false;
      const Transition strike = LinkageWalker(unlimited).strike(free, true);
      EXPECT_LT((strike.after.q - expected.q).norm(), 1e-9);
      EXPECT_LT((strike.after.qd - expected.qd).norm(), 1e-9 * expected.qd.norm());
    }
  }
}

bool lets_go_of_stance_knee(const WalkerStep& step) {
  for (const WalkerEvent& event : step.events) {
    if (event.transition.kind == EventKind::kRelease) return true;
  }
  return false;
}

// The nine cycles return to their start, here with the general implementation. In the two whose
// stance knee leaves its stop the file released it at the end of a 1 ms step; with the event
// located, they end up to 4.6e-4 rad/s away (kneed_advance_test.cpp shows the cause).
TEST(LinkageWalker, ReproducesThePoweredCycles) {
  const CycleFile file = read_kneed_cycles();
  int released = 0;
  for (const ReferenceCycle& row : file.cycles) {
    SCOPED_TRACE(row.speed);
    const LinkageWalker walker(kneed(file.parameters, row.controls, {.may_fly = false}));
    const WalkerState start = walker.section_state(row.start.q, row.start.qd);
    const auto step = take_step(walker, start, {}, 5);
    ASSERT_TRUE(step);
    const bool releases = lets_go_of_stance_knee(*step);
    released += releases ? 1 : 0;
    const double tolerance = releases ? 5e-4 : 1e-7;
    EXPECT_LT((step->end.q - start.q).norm(), tolerance);
    EXPECT_LT((step->end.qd - start.qd).norm(), tolerance);
    EXPECT_NEAR(step->period, row.period, 1e-4);  // printed digits
    EXPECT_NEAR(step->step_length, row.step_length, 1e-4);
    EXPECT_GT(step->travel, step->step_length);  // the stance foot rolls in addition
  }
  EXPECT_EQ(released, 2);
}

// The two cycles whose stance stop is released, which their source noticed only at the end of a 1
// ms step.
class LateRelease : public LinkageWalker {
 public:
  using LinkageWalker::LinkageWalker;
  std::vector<Guard> guards(const WalkerState& state) const override {
    std::vector<Guard> all = LinkageWalker::guards(state);
    std::erase_if(all, [](const Guard& guard) { return !guard.rate; });  // a stop's force
    return all;
  }
};

TEST(LinkageWalker, ReleasingLateReproducesTheRemainingCycles) {
  const CycleFile file = read_kneed_cycles();
  for (const size_t i : {6u, 7u}) {  // 1.6 and 1.8 m/s
    const ReferenceCycle& row = file.cycles[i];
    SCOPED_TRACE(row.speed);
    const LateRelease walker(kneed(file.parameters, row.controls, {.may_fly = false}));
    const WalkerState start = walker.section_state(row.start.q, row.start.qd);
    WalkerState state = start;
    std::vector<WalkerEvent> events;
    double step_end = 1e-3;
    while (!advance(walker, state, step_end - state.time, {}, events)) {
      ASSERT_EQ(state.health, Health::kSound);
      state = walker.settled(state);
      // Its steps began anew at every event.
      const double anew = events.empty() ? 0 : events.back().time;
      step_end = anew + 1e-3 * (std::floor((state.time - anew) / 1e-3 + 1e-6) + 1);
    }
    EXPECT_LT((state.q - start.q).norm(), 1e-7);
    EXPECT_LT((state.qd - start.qd).norm(), 1e-7);
  }
}

// Newton's method from a disturbed start finds the cycle again, with the file's multipliers.
TEST(LinkageWalker, FindsAPoweredCycleAndItsMultipliers) {
  const CycleFile file = read_kneed_cycles();
  const ReferenceCycle& row = file.cycles[2];  // 1 m/s
  const LinkageWalker walker(kneed(file.parameters, row.controls, {.may_fly = false}));
  VectorXd guess(10);
  guess << row.start.q, 1.002 * row.start.qd;
  const auto gait = find_gait(walker, guess);
  ASSERT_TRUE(gait);
  EXPECT_LT((gait->start.q - row.start.q).norm(), 1e-7);
  EXPECT_LT((gait->start.qd - row.start.qd).norm(), 1e-7);
  const std::vector<double> multipliers{.834, .483, .483, .234};
  for (size_t i = 0; i < multipliers.size(); ++i) {
    EXPECT_NEAR(std::abs(gait->cycle.multipliers(static_cast<Index>(i))), multipliers[i], 2e-3);
  }
}

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

// A limiting case: latched knees, shank mass tending to zero and the thigh's mass at the leg's
// centre give the straight-legged walker.
TEST(LinkageWalker, LatchedKneesWithLightShanksAreGoswamisLegs) {
  const StraightLeggedParameters straight = goswami();
  KneedParameters p;
  p.gravity = 9.81;
  p.slope = straight.slope;
  p.thigh_length = .6;
  p.shank_length = .4;
  p.torso.mass = 10;
  p.thigh = {.mass = 5, .com_below_hip = .5, .inertia = 0};
  p.shank = {.mass = 1e-9, .com_above_ankle = .2, .com_forward = 0, .inertia = 0};
  Linkage locked = kneed(p, {}, {.latched = true, .may_fly = false});
  locked.may_scuff = true;
  const LinkageWalker kneed_walker(locked), straight_walker(straight_legged(straight));
  const VectorXd q = Vector2d(-.2710, .2710), qd = Vector2d(1.0924, .3774);
  WalkerState theirs = straight_walker.section_state(q, qd);
  WalkerState ours = kneed_walker.section_state(Eigen::Vector4d(q(0), q(1), q(0), q(1)),
                                                Eigen::Vector4d(qd(0), qd(1), qd(0), qd(1)));
  ours.active = 3;  // both latches closed from the start
  std::vector<WalkerEvent> events;
  ASSERT_TRUE(advance(straight_walker, theirs, 2, {}, events));
  ASSERT_TRUE(advance(kneed_walker, ours, 2, {}, events));
  EXPECT_NEAR(ours.time, theirs.time, 1e-7);
  EXPECT_LT((ours.q.head(2) - theirs.q).norm(), 1e-7);
  EXPECT_LT((ours.qd.head(2) - theirs.qd).norm(), 1e-7);
}

TEST(LinkageWalker, SmallFeetApproachPointFeet) {
  StraightLeggedParameters p = goswami();
  const VectorXd guess = Eigen::Vector4d(-.271028680, .271028680, 1.092383590, .377373949);
  std::vector<double> error;
  for (const double radius : {1e-3, 1e-4}) {
    p.foot_radius = radius;
    const auto gait = find_gait(LinkageWalker(straight_legged(p)), guess);
    ASSERT_TRUE(gait);
    error.push_back((gait->start.q - guess.head(2)).norm());
  }
  EXPECT_LT(error[0], 1e-2);
  EXPECT_NEAR(error[0] / error[1], 10, 0.5);  // linear in the radius
}

TEST(LinkageWalker, SpreadLimitHoldsTheLegs) {
  StraightLeggedParameters p;
  p.slope = .010;
  p.widest_spread = 0.45;  // less than the gait's .515: the legs must stop against it
  const LinkageWalker walker(straight_legged(p));
  WalkerState state = walker.section_state(Vector2d(-.2, .2), Vector2d(.45, .2));
  double widest = 0;
  int stops = 0;
  std::vector<WalkerEvent> events;
  for (int i = 0; i < 4 && state.health == Health::kSound; ++i) {
    advance(walker, state, 6, {}, events, [&](const WalkerState& now) {
      widest = std::max(widest, std::abs(now.q(0) - now.q(1)));
    });
  }
  for (const WalkerEvent& event : events) stops += event.transition.kind == EventKind::kStop;
  EXPECT_GT(stops, 0);
  EXPECT_LT(widest, p.widest_spread + 1e-9);
}

// Running: when it is thrown upwards hard enough, the stance foot is released, the walker flies on
// a parabola and lands on the other foot.
TEST(LinkageWalker, FliesBallisticallyAndLands) {
  const CycleFile file = read_kneed_cycles();
  const ReferenceCycle& row = file.cycles.back();  // 1.8 m/s: its ground reaction would pull
  const LinkageWalker walker(kneed(file.parameters, row.controls, {.may_fly = true}));
  WalkerState state = walker.section_state(row.start.q, row.start.qd);
  std::vector<WalkerEvent> events;
  std::vector<WalkerState> flight;
  advance(walker, state, 1, {}, events, [&](const WalkerState& now) {
    if (now.phase == LinkageWalker::kFlight) flight.push_back(now);
  });
  ASSERT_GT(flight.size(), 5u);
  const WalkerState &first = flight.front(), &last = flight.back();
  const double t = last.time - first.time;
  const PlanarMomentum start = walker.momentum(first), end = walker.momentum(last);
  const Vector2d g(0, -file.parameters.gravity);
  EXPECT_LT((start.com + t * start.linear / start.mass + t * t / 2 * g - end.com).norm(),
            2e-7);  // RK4, stiff knees
  EXPECT_NEAR(end.angular, start.angular, 1e-7 * (1 + std::abs(start.angular)));
  EXPECT_TRUE(walker.contact_forces(first).empty());
}

TEST(LinkageWalker, FallsAreAStateAndFeetInOnePlaceAreNoStrike) {
  const LinkageWalker walker(straight_legged({}));
  WalkerState state = walker.section_state(Vector2d(0, 0), Vector2d(0, 0));
  std::vector<WalkerEvent> events;
  state.qd(0) = -0.5;  // falls backwards
  EXPECT_FALSE(advance(walker, state, 20, {}, events));
  EXPECT_EQ(state.health, Health::kFallen);
  EXPECT_TRUE(state.q.allFinite());
  state = walker.section_state(Vector2d(0, 0), Vector2d(0, 0));
  EXPECT_FALSE(advance(walker, state, 0.5, {}, events));  // an unstable balance without an event
  EXPECT_EQ(state.health, Health::kSound);
}

TEST(LinkageWalker, AStartThatLiesOnTheGroundHasFallen) {
  const LinkageWalker walker(straight_legged({}));
  EXPECT_EQ(walker.section_state(Vector2d(1.5, -1.5), Vector2d(0, 0)).health, Health::kFallen);
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

// Rates that differ from the cycle by 5 % flex knees at rest and straighten flexed ones. Some
// walkers fall; none has a stop that fires for ever.
TEST(LinkageWalker, DisturbedWalksEndInNoChatter) {
  const CycleFile file = read_kneed_cycles();
  const ReferenceCycle& row = file.cycles.back();
  const LinkageWalker walker(kneed(file.parameters, row.controls, {.may_fly = false}));
  for (uint32_t i = 0; i < 16; ++i) {
    Rng rng(25, Purpose::kTest, i);
    VectorXd rates = row.start.qd;
    for (double& rate : rates) rate *= 1 + 0.05 * rng.normal();
    WalkerState state = walker.section_state(row.start.q, rates);
    std::vector<WalkerEvent> events;
    while (state.health == Health::kSound && state.time < 3) {
      if (!advance(walker, state, 3 - state.time, {}, events)) break;
    }
    EXPECT_NE(state.health, Health::kDiverged) << i << " at " << state.time << " s";
  }
}

}  // namespace
}  // namespace walktrack
