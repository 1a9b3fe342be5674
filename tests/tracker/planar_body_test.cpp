#include "tracker/motion/models/planar_body.h"

#include <gtest/gtest.h>

#include "core/conventions.h"

namespace walktrack {
namespace {

// The published cycles of the kneed walker (tests/walker/kneed_cycles.yaml) belong to this subject:
// its parameters, which were computed from the anthropometric table independently, are the oracle.
TEST(KneedParameters, OfTheReferenceSubject) {
  const KneedParameters p = kneed_parameters({.height = 1.75, .mass = 70, .lengths = {}}, 9.80665);
  EXPECT_NEAR(p.thigh_length, 0.42875, 1e-9);
  EXPECT_NEAR(p.shank_length, 0.4305, 1e-9);
  EXPECT_NEAR(p.foot_radius, 0.27825, 1e-9);
  EXPECT_NEAR(p.foot_forward, 0.05, 1e-5);
  EXPECT_NEAR(p.foot_up, 0.21, 1e-9);
  EXPECT_NEAR(p.torso.mass, 47.46, 1e-9);
  EXPECT_NEAR(p.torso.com_above_hip, 0.315504, 1e-9);
  EXPECT_NEAR(p.torso.inertia, 2.965870332, 1e-8);
  EXPECT_NEAR(p.thigh.com_below_hip, 0.18564875, 1e-9);
  EXPECT_NEAR(p.thigh.inertia, 0.1342490901, 1e-9);
  EXPECT_NEAR(p.shank.com_above_ankle, 0.169617, 1e-9);
  EXPECT_NEAR(p.shank.inertia, 0.1369496251, 1e-9);
}

}  // namespace
}  // namespace walktrack
