#include "walker/linkage/linkage_walker.h"

#include <cmath>

#include <gtest/gtest.h>

#include "reference_kneed.h"
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

}  // namespace
}  // namespace walktrack
