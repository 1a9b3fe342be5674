// Laws of the kneed walker, for walkers and states of every kind.
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/conventions.h"
#include "tests/walker/kneed_files.h"
#include "walker/kneed/kneed_advance.h"

namespace walktrack {
namespace {

double between(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 10'001) / 1e4;
}

// A walker with a person's build, varied by up to a half.
KneedParameters some_walker() {
  static const KneedParameters kPerson = read_kneed_reference().parameters;
  KneedParameters p = kPerson;
  for (double* value : {&p.torso.mass, &p.torso.inertia, &p.thigh.mass, &p.thigh.inertia,
                        &p.shank.mass, &p.shank.inertia, &p.thigh_length, &p.shank_length,
                        &p.foot_radius, &p.foot_forward, &p.gravity})
    *value *= between(0.5, 1.5);
  p.slope = between(-0.7, 0.7);
  return p;
}

// A step with flexed knees.
KneedState some_state() {
  KneedState s;
  s.q[kTorso] = between(-0.3, 0.3);
  s.q[kStanceThigh] = between(-0.5, 0.5);
  s.q[kSwingThigh] = between(-0.8, 0.8);
  s.q[kStanceShank] = s.q[kStanceThigh] + between(0.05, 0.4);
  s.q[kSwingShank] = s.q[kSwingThigh] + between(0.05, 1.2);
  for (double& rate : s.qd) rate = between(-4, 4);
  return s;
}

KneedControls some_controls() {
  const auto spring = [] {
    return SpringDamper{between(0, 300), between(0, 30), between(-0.5, 0.5)};
  };
  return {spring(), spring(), spring(), spring(), between(0, 60)};
}

// The mirrored walker: everything in front is behind.
KneedParameters mirrored(KneedParameters p) {
  p.slope = -p.slope;
  p.foot_forward = -p.foot_forward;
  p.shank.com_forward = -p.shank.com_forward;
  return p;
}
KneedState mirrored(KneedState s) {
  s.q = -s.q;
  s.qd = -s.qd;
  return s;
}
KneedControls mirrored(KneedControls c) {
  for (SpringDamper* spring : {&c.torso, &c.hip, &c.stance_knee, &c.swing_knee})
    spring->rest = -spring->rest;
  return c;
}

RC_GTEST_PROP(WalkerLaw, MirroredItMovesAsItsMirrorImage, ()) {
  const KneedParameters parameters = some_walker();
  const KneedControls controls = some_controls();
  const KneedState state = some_state();
  const Vector5 ours =
      kneed_accelerations(kneed_model(parameters), controls, Vector5::Zero(), state).qdd;
  const Vector5 theirs = kneed_accelerations(kneed_model(mirrored(parameters)), mirrored(controls),
                                             Vector5::Zero(), mirrored(state))
                             .qdd;
  // The same sums with other signs: rounding times the mass matrix's condition (about 1e3).
  RC_ASSERT((ours + theirs).norm() <= 1e-11 * (1 + ours.norm()));
}

// Without springs only gravity does work on a walker that rolls on a foot; knee stops and strikes
// only remove energy.
RC_GTEST_PROP(WalkerLaw, WithoutSpringsItKeepsItsEnergyButForKneesAndFeetThatStrike, ()) {
  const KneedModel model = kneed_model(some_walker());
  const bool bent = *rc::gen::arbitrary<bool>();
  KneedState state = some_state();
  for (const int shank : {kStanceShank, kSwingShank}) state.q[shank] += bent ? 0.4 : 0;
  const KneedEnergy before = kneed_energy(model, state);
  constexpr double kTime =
      0.02;  // s; knees that are flexed by 0.4 rad straighten at 8 rad/s and stay flexed
  const KneedAdvance done = kneed_advance(model, {}, Vector5::Zero(), state, kTime,
                                          {.max_step = 5e-4, .min_hip_height = 0});
  RC_PRE(done.event == KneedEvent::kNone || !bent);
  const KneedEnergy after = kneed_energy(model, state);
  const double gained = after.kinetic + after.potential - before.kinetic - before.potential;
  // RK4 at 0.5 ms: (rates of 30 rad/s times step)^4 of what moves.
  const double tolerance = 1e-6 * (before.kinetic + std::abs(before.potential) + after.kinetic);
  // The potential's origin moves with the ground at a transfer.
  if (done.event == KneedEvent::kNone) RC_ASSERT(gained <= tolerance);
  if (bent) RC_ASSERT(gained >= -tolerance);
}

RC_GTEST_PROP(WalkerLaw, AStrikeWithoutToeOffNeverGivesEnergy, ()) {
  const KneedModel model = kneed_model(some_walker());
  const KneedState before = some_state();
  const KneedState after = kneed_support_transfer(model, 0, before).state;
  const double kinetic = kneed_energy(model, before).kinetic;
  RC_ASSERT(kneed_energy(model, after).kinetic <= kinetic * (1 + 1e-9));
  RC_ASSERT(after.q[kStanceThigh] == before.q[kSwingThigh]);
}

// For any input it advances, or states the outcome with a valid state.
RC_GTEST_PROP(WalkerLaw, ItNeverLeavesANumberThatIsNone, ()) {
  const KneedModel model = kneed_model(some_walker());
  KneedState state = some_state();
  state.qd *= between(0, 100);
  Vector5 noise;
  for (double& torque : noise) torque = between(-500, 500);
  const KneedAdvance done = kneed_advance(model, some_controls(), noise, state, 0.05);
  RC_ASSERT(state.q.allFinite() && state.qd.allFinite());
  RC_ASSERT(done.elapsed >= 0 && done.elapsed <= 0.05 * (1 + 1e-12));
  if (done.event == KneedEvent::kNone) RC_ASSERT(std::abs(done.elapsed - 0.05) < 1e-12);
}

}  // namespace
}  // namespace walktrack
