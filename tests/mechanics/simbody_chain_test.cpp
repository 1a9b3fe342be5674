// The 3-D articulated body compared with an independent engine (Simbody), if it is installed.
#include <gtest/gtest.h>

#include "mechanics/articulated_dynamics.h"
#include "tests/mechanics/sample_bodies.h"
#include "tests/simbody/tree.h"

#if WALKTRACK_HAS_SIMBODY

#include <Eigen/Geometry>

namespace walktrack {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

simbody::Joint joint_of(const ArticulatedPart& part) {
  if (part.parent < 0) return simbody::Joint::kFree;
  if (part.joint == JointKind::kHinge) return simbody::Joint::kPin;
  return part.joint == JointKind::kBall ? simbody::Joint::kBall : simbody::Joint::kWeld;
}

std::vector<simbody::Part> same_tree(const ArticulatedBody& body) {
  std::vector<simbody::Part> parts;
  for (const ArticulatedPart& part : body.parts()) {
    const bool is_root = part.parent < 0;
    parts.push_back({part.mass.mass, part.mass.com, inertia_about(part.mass, Vector3d::Zero()),
                     part.parent, joint_of(part), is_root ? Vector3d(0, 0, 0) : part.anchor,
                     rotation_matrix(is_root ? identity_quaternion() : part.rest), part.axis});
  }
  return parts;
}

// Weight, applied forces and joint torques (reversed on the parent) at the parts' origins.
std::vector<simbody::Load> same_load(const ArticulatedBody& body,
                                     const std::vector<PartMotion>& motions, const BodyLoad& load) {
  std::vector<simbody::Load> loads;
  for (size_t i = 0; i < motions.size(); ++i) {
    const MassProperties& mass = body.parts()[i].mass;
    const Vector3d weight = mass.mass * load.gravity;
    loads.push_back({(motions[i].rotation * mass.com).cross(weight), weight});
  }
  for (const PartForce& applied : load.forces) {
    const Vector3d arm = motions[applied.part].rotation * applied.point;
    loads[applied.part].torque += applied.torque + arm.cross(applied.force);
    loads[applied.part].force += applied.force;
  }
  const VectorXd& tau = load.joint_forces;
  loads[0].force += tau.head<3>();
  loads[0].torque += motions[0].rotation * tau.segment<3>(3);
  for (size_t i = 1; i < motions.size(); ++i) {
    const ArticulatedPart& part = body.parts()[i];
    const Eigen::Index v = body.velocity_index(i);
    Vector3d torque = Vector3d::Zero();
    if (part.joint == JointKind::kHinge) torque = motions[i].rotation * (part.axis * tau(v));
    if (part.joint == JointKind::kBall) torque = motions[i].rotation * tau.segment<3>(v);
    loads[i].torque += torque;
    loads[static_cast<size_t>(part.parent)].torque -= torque;
  }
  return loads;
}

TEST(SimbodyChain, ForwardDynamicsAgrees) {
  const ArticulatedBody body = sample_body();
  Rng rng(51, Purpose::kTest);
  for (int k = 0; k < 25; ++k) {
    const VectorXd q = random_positions(body, rng), u = random_vector(rng, body.velocities(), 3);
    BodyLoad load;
    load.joint_forces = random_vector(rng, body.velocities(), 10);
    load.forces.push_back({5, random_vector(rng, 3), random_vector(rng, 3, 30), {1, 2, 3}});
    const VectorXd u_dot = forward_dynamics(body, q, u, load, {}, 0).u_dot;
    const auto ours = part_motions(body, q, u, u_dot);
    std::vector<simbody::Motion> poses;
    for (const PartMotion& m : ours) poses.push_back({m.rotation, m.origin, m.omega, m.velocity});
    const auto theirs = simbody::accelerations(same_tree(body), poses, same_load(body, ours, load));
    for (size_t i = 0; i < ours.size(); ++i) {
      const double size = 1 + ours[i].alpha.norm() + ours[i].acceleration.norm();
      EXPECT_LT((theirs[i].alpha - ours[i].alpha).norm(), 1e-9 * size) << "part " << i;
      EXPECT_LT((theirs[i].linear - ours[i].acceleration).norm(), 1e-9 * size) << "part " << i;
    }
  }
}

}  // namespace
}  // namespace walktrack

#else

TEST(SimbodyChain, ForwardDynamicsAgrees) { GTEST_SKIP() << "Simbody is not installed"; }

#endif
