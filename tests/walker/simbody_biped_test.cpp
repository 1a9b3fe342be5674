// The kneed walker as a linkage compared with Simbody, if it is installed: five links on a foot
// that rolls without slip.
#include <cmath>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "tests/mechanics/random_state.h"
#include "tests/simbody/tree.h"
#include "tests/walker/kneed_files.h"
#include "walker/linkage/linkage_walker.h"
#include "walker/linkage/models.h"

#if WALKTRACK_HAS_SIMBODY

namespace walktrack {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// A planar part: x forward of it, z up along it, origin at its joint.
simbody::Part part(double mass, double inertia, int parent, double anchor_x, double anchor_z,
                   double com_x, double com_z) {
  const Vector3d com(com_x, 0, com_z);
  const Matrix3d about_origin =
      inertia * Matrix3d::Identity() +
      mass * (com.squaredNorm() * Matrix3d::Identity() - com * com.transpose());
  return {mass,
          com,
          about_origin,
          parent,
          simbody::Joint::kPin,
          Vector3d(anchor_x, 0, anchor_z),
          Matrix3d::Identity(),
          Vector3d::UnitY()};
}

// Stance shank (origin at its arc centre), stance thigh, torso, swing thigh, swing shank.
std::vector<simbody::Part> same_biped(const KneedParameters& p) {
  const KneedShank& s = p.shank;
  return {part(s.mass, s.inertia, -1, 0, 0, s.com_forward - p.foot_forward,
               s.com_above_ankle - p.foot_up),
          part(p.thigh.mass, p.thigh.inertia, 0, -p.foot_forward, p.shank_length - p.foot_up, 0,
               p.thigh_length - p.thigh.com_below_hip),
          part(p.torso.mass, p.torso.inertia, 1, 0, p.thigh_length, 0, p.torso.com_above_hip),
          part(p.thigh.mass, p.thigh.inertia, 1, 0, p.thigh_length, 0, -p.thigh.com_below_hip),
          part(s.mass, s.inertia, 3, 0, -p.thigh_length, s.com_forward,
               s.com_above_ankle - p.shank_length)};
}

TEST(SimbodyBiped, AccelerationsAgree) {
  const ReferenceFile reference = read_kneed_reference();
  const KneedParameters& p = reference.parameters;
  const LinkageWalker walker(kneed(p, {}, {.may_fly = false}));
  const std::vector<Eigen::Index> order{3, 1, 0, 2, 4};  // Simbody's order from the linkage's
  Rng rng(71, Purpose::kTest);
  for (int i = 0; i < 25; ++i) {
    WalkerState state;
    state.q = random_vector(rng, 5, 0.8);
    state.qd = random_vector(rng, 5, 4);
    state.contacts = {0, 0};
    const VectorXd torque = random_vector(rng, 5, 50);
    const TmtSystem system = walker.system(state);
    const VectorXd ours = solve_mass(system.mass, system.force + torque);
    std::vector<double> angles, rates, torques;
    for (const Eigen::Index k : order) {
      angles.push_back(state.q(k));
      rates.push_back(state.qd(k));
      torques.push_back(torque(k));
    }
    const auto theirs = simbody::rolling_chain(same_biped(p), p.foot_radius, angles, rates,
                                               p.gravity * std::sin(p.slope),
                                               -p.gravity * std::cos(p.slope), torques);
    for (size_t k = 0; k < order.size(); ++k) {
      EXPECT_NEAR(theirs[k], ours(order[k]), 1e-9 * (1 + ours.norm()));
    }
  }
}

}  // namespace
}  // namespace walktrack

#else

TEST(SimbodyBiped, AccelerationsAgree) { GTEST_SKIP() << "Simbody is not installed"; }

#endif
