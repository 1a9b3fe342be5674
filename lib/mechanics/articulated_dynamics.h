// Dynamics of an articulated body (articulated.h): forward by the TMT assembly with attachment
// constraints as an augmented system, inverse by recursive Newton-Euler. The two are independent
// derivations; tests compare them with each other and both with Simbody.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/conventions.h"
#include "mechanics/articulated.h"
#include "mechanics/constraints.h"
#include "mechanics/integrator.h"
#include "mechanics/tmt.h"

namespace walktrack {
inline namespace mechanics {

// A force on a part, world axes.
struct PartForce {
  size_t part = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   // point of application, part's frame, m
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  // an additional couple, N m
};

// A point of a part that is held at a point of the world (a hand on a rail, a foot on the ground).
struct Attachment {
  size_t part = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   // part's frame, m
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  // world, m
};

// All forces on the body except its own inertia.
struct BodyLoad {
  Eigen::Vector3d gravity = Eigen::Vector3d(0, 0, -kStandardGravity);  // m/s^2
  Eigen::VectorXd joint_forces;  // tau, size of u; empty: zero
  std::vector<PartForce> forces;
};

// Mass matrix and right-hand side of M u_dot = force.
TmtSystem assemble(const ArticulatedBody& body, const Eigen::VectorXd& q, const Eigen::VectorXd& u,
                   const BodyLoad& load);

// Value, Jacobian and convective term of all attachments, three rows each.
Constraint attachment_constraint(const ArticulatedBody& body, const Eigen::VectorXd& q,
                                 const Eigen::VectorXd& u, std::span<const Attachment> attachments);

struct ForwardDynamics {
  Eigen::VectorXd u_dot;
  std::vector<Eigen::Vector3d> attachment_forces;  // of the world on the body, N
};
ForwardDynamics forward_dynamics(const ArticulatedBody& body, const Eigen::VectorXd& q,
                                 const Eigen::VectorXd& u, const BodyLoad& load,
                                 std::span<const Attachment> attachments, double baumgarte_rate);

struct InverseDynamics {
  // tau that produces u_dot together with load.forces and gravity. The first three entries are the
  // force and the next three the torque (root axes, about the root's origin) that are missing at
  // the root: the ground reaction, if no other force was given.
  Eigen::VectorXd tau;
  // Force and moment of the parent on each part at its joint, world axes; for the root the missing
  // force and moment.
  std::vector<Eigen::Vector3d> joint_force, joint_moment;
};
InverseDynamics inverse_dynamics(const ArticulatedBody& body, const Eigen::VectorXd& q,
                                 const Eigen::VectorXd& u, const Eigen::VectorXd& u_dot,
                                 const BodyLoad& load);

struct ArticulatedState {
  Eigen::VectorXd q, u;
};

struct ArticulatedStepOptions {
  Integrator integrator = Integrator::kRk4;
  Stabilisation stabilisation = Stabilisation::kProjection;
  double baumgarte_rate = 10;  // 1/s, used by kBaumgarte
};

// One step under a constant load, quaternions renormalised. nullopt: diverged.
std::optional<ArticulatedState> step(const ArticulatedBody& body, const ArticulatedState& state,
                                     const BodyLoad& load, std::span<const Attachment> attachments,
                                     double dt, const ArticulatedStepOptions& options);

}  // namespace mechanics
}  // namespace walktrack
