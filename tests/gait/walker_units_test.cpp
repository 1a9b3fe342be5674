#include "gait/walker_units.h"

#include <gtest/gtest.h>

#include "tests/walker/kneed_files.h"
#include "walker/kneed/kneed_advance.h"

namespace walktrack {
namespace {

TEST(WalkerUnits, AdultWalkerIsTheOneOfTheReferenceCycles) {
  const KneedParameters found = adult_walker(1.75, 70), expected = read_kneed_cycles().parameters;
  // The file has nine digits.
  EXPECT_NEAR(found.thigh_length, expected.thigh_length, 1e-9);
  EXPECT_NEAR(found.shank_length, expected.shank_length, 1e-9);
  EXPECT_NEAR(found.foot_radius, expected.foot_radius, 1e-9);
  EXPECT_NEAR(found.foot_forward, expected.foot_forward, 1e-9);
  EXPECT_NEAR(found.foot_up, expected.foot_up, 1e-9);
  EXPECT_NEAR(found.torso.mass, expected.torso.mass, 1e-9);
  EXPECT_NEAR(found.torso.com_above_hip, expected.torso.com_above_hip, 1e-9);
  EXPECT_NEAR(found.torso.inertia, expected.torso.inertia, 1e-8);
  EXPECT_NEAR(found.thigh.mass, expected.thigh.mass, 1e-9);
  EXPECT_NEAR(found.thigh.com_below_hip, expected.thigh.com_below_hip, 1e-9);
  EXPECT_NEAR(found.thigh.inertia, expected.thigh.inertia, 1e-9);
  EXPECT_NEAR(found.shank.mass, expected.shank.mass, 1e-9);
  EXPECT_NEAR(found.shank.com_above_ankle, expected.shank.com_above_ankle, 1e-9);
  EXPECT_NEAR(found.shank.com_forward, expected.shank.com_forward, 1e-9);
  EXPECT_NEAR(found.shank.inertia, expected.shank.inertia, 1e-9);
}

TEST(WalkerUnits, UnitWalkerHasUnitLegMassAndGravity) {
  const WalkerUnits units = walker_units(unit_walker());
  EXPECT_NEAR(units.length, 1, 1e-12);
  EXPECT_NEAR(units.mass, 1, 1e-12);
  EXPECT_EQ(units.gravity, 1);
}

// Walkers with the same proportions differ only in units: a scaled start with scaled controls gives
// the scaled motion.
TEST(WalkerUnits, ScaledWalkersMoveAlike) {
  const CycleFile file = read_kneed_cycles();
  const auto& cycle = file.cycles[2];
  const WalkerUnits from = walker_units(file.parameters);
  const KneedParameters small = adult_walker(1.2, 25);
  const WalkerUnits to = walker_units(small);
  KneedState a = cycle.start, b = scaled(a, from, to);
  const auto step_a = kneed_advance(kneed_model(file.parameters), cycle.controls, Vector5::Zero(),
                                    a, 2, {.max_step = 0.0005});
  const auto step_b = kneed_advance(kneed_model(small), scaled(cycle.controls, from, to),
                                    Vector5::Zero(), b, 2, {.max_step = 0.0005});
  ASSERT_EQ(step_b.event, KneedEvent::kTransfer);
  // Integration errors differ with the steps: 1e-7 at 0.5 ms.
  EXPECT_NEAR(step_b.elapsed / to.time(), step_a.elapsed / from.time(), 1e-6);
  EXPECT_NEAR(step_b.step_length / to.length, step_a.step_length / from.length, 1e-6);
  EXPECT_LT((scaled(b, to, from).qd - a.qd).norm(), 1e-5);
}

}  // namespace
}  // namespace walktrack
