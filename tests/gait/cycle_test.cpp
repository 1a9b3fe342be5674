#include "gait/cycle.h"

#include <cmath>

#include <gtest/gtest.h>

#include "gait/walker_units.h"
#include "tests/walker/kneed_files.h"

namespace walktrack {
namespace {

struct Published {
  GaitVector gait;
  GaitTarget target;
};

// The inverse of controls_from().
ControlVector control_vector(const KneedControls& controls) {
  ControlVector v;
  int i = 0;
  for (const SpringDamper& joint :
       {controls.torso, controls.hip, controls.stance_knee, controls.swing_knee}) {
    v[i++] = std::sqrt(joint.stiffness);
    v[i++] = std::sqrt(joint.damping);
    v[i++] = joint.rest;
  }
  v[i] = controls.toe_off_impulse;
  return v;
}

Published published(size_t index) {
  const CycleFile file = read_kneed_cycles();
  const WalkerUnits units = walker_units(file.parameters);
  const auto& cycle = file.cycles[index];
  Published p;
  p.gait << control_vector(scaled(cycle.controls, units, {})),
      section_of(scaled(cycle.start, units, {}));
  const auto step = step_of(kneed_model(unit_walker()), p.gait);
  p.target = {step->measures.length / step->measures.period, step->measures.length};
  return p;
}

TEST(StepMap, VectorsReturnWhatTheyWereMadeOf) {
  const CycleFile file = read_kneed_cycles();
  const KneedModel model = kneed_model(file.parameters);
  for (const auto& cycle : file.cycles) {
    const KneedControls c = controls_from(control_vector(cycle.controls));
    EXPECT_NEAR(c.hip.stiffness, cycle.controls.hip.stiffness, 1e-9);
    EXPECT_NEAR(c.swing_knee.damping, cycle.controls.swing_knee.damping, 1e-9);
    EXPECT_EQ(c.torso.rest, cycle.controls.torso.rest);
    EXPECT_EQ(c.toe_off_impulse, cycle.controls.toe_off_impulse);
    // The swing shank follows from the foot on the ground; the file has 12 digits.
    const auto state = state_from(model, section_of(cycle.start));
    ASSERT_TRUE(state);
    EXPECT_LT((state->q - cycle.start.q).norm(), 1e-9);
    EXPECT_NEAR(kneed_swing_foot(model, *state).height, 0, 1e-12);
  }
}

TEST(StepMap, NoStateWhereTheFootCannotReachTheGround) {
  SectionVector section = SectionVector::Zero();
  section[2] = 2.5;  // thigh far behind and up: the shank is too short
  EXPECT_FALSE(state_from(kneed_model(unit_walker()), section));
}

TEST(Cycle, MultipliersAreThePublishedOnes) {
  const KneedModel model = kneed_model(unit_walker());
  const std::array<std::array<double, 4>, 3> expected{
      {{0.86, 0.614, 0.614, 0.246}, {0.828, 0.57, 0.382, 0.382}, {0.834, 0.483, 0.483, 0.234}}};
  for (size_t i = 0; i < expected.size(); ++i) {
    const auto p = published(i);
    const auto jacobian = cycle_jacobian(model, p.gait);
    ASSERT_TRUE(jacobian);
    const SectionVector found = multipliers(step_matrix(*jacobian));
    // Published with about three digits.
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(found[k], expected[i][size_t(k)], 2e-3);
  }
}

TEST(Cycle, NewtonReturnsToTheCycle) {
  const KneedModel model = kneed_model(unit_walker());
  const auto p = published(1);
  GaitVector guess = p.gait;
  guess.head<kControlSize>() *= 1.02;
  const auto found = find_cycle(model, guess, p.target);
  ASSERT_TRUE(found);
  const auto step = step_of(model, *found);
  EXPECT_LT(cycle_residual(*found, *step, p.target).norm(), 1e-9);
}

TEST(Cycle, ContinuationReachesShorterStepsAndSlopes) {
  const auto p = published(1);
  for (const double slope : {0.0, 0.03, -0.03}) {
    const GaitTarget to{p.target.speed * 1.02, p.target.step_length * 0.9, slope};
    const auto found = continue_cycle(p.gait, p.target, to);
    ASSERT_TRUE(found) << slope;
    const auto step = step_of(unit_model(to), *found);
    EXPECT_NEAR(step->measures.length / step->measures.period, to.speed, 1e-8);
    EXPECT_NEAR(step->measures.length, to.step_length, 1e-8);
  }
}

TEST(Cycle, HopelessGuessIsNoCycle) {
  const GaitVector zero = GaitVector::Zero();
  EXPECT_FALSE(find_cycle(kneed_model(unit_walker()), zero, {0.4, 0.7}));
}

}  // namespace
}  // namespace walktrack
