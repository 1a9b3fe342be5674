// One free rigid body: Newton-Euler equations with the rotation in body axes,
//   m dv/dt = f,   I' d(omega')/dt = tau' - omega' x (I' omega'),   dq/dt = 1/2 q o (0, omega').
// State: centre of mass c (world), q = world_from_body, velocity v (world), angular velocity
// omega' (body axes). Primes mark body axes. The torque of a force f at x about c is (x - c) x f
// (the lecture has the factors reversed).
#pragma once

#include <optional>

#include <Eigen/Core>

#include "mechanics/integrator.h"
#include "mechanics/quaternion.h"

namespace walktrack {

struct RigidBody {
  double mass = 1;                                        // kg
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Identity();  // kg m^2, about c, body axes
};

struct RigidBodyState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();    // c, m, world
  Quaternion orientation = identity_quaternion();        // world_from_body
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();    // m/s, world
  Eigen::Vector3d omega_body = Eigen::Vector3d::Zero();  // rad/s, body axes
};

struct RigidBodyLoad {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();        // N, world
  Eigen::Vector3d torque_body = Eigen::Vector3d::Zero();  // N m, body axes
};

using LoadLaw = std::function<RigidBodyLoad(double time, const RigidBodyState& state)>;

// (x - c) x f, world axes.
Eigen::Vector3d torque_about(const Eigen::Vector3d& c, const Eigen::Vector3d& x,
                             const Eigen::Vector3d& f);

// d(omega')/dt
Eigen::Vector3d angular_acceleration(const RigidBody& body, const Eigen::Vector3d& omega_body,
                                     const Eigen::Vector3d& torque_body);

// One step, orientation renormalised. nullopt: diverged.
std::optional<RigidBodyState> step(const RigidBody& body, const RigidBodyState& state,
                                   const LoadLaw& load, double time, double dt,
                                   Integrator integrator);

double kinetic_energy(const RigidBody& body, const RigidBodyState& state);                  // J
Eigen::Vector3d spin_angular_momentum(const RigidBody& body, const RigidBodyState& state);  // world

// The same rotation by the lecture's quaternion equation with the explicit constraint q^T q = 1
// (J = diag(0, I'), a prime marks body axes, Q = left_matrix(q), Qd = left_matrix(dq/dt)):
//   [ 4 Q J Q^T  2 q ] [ q_ddot ]   [ 2 Q (0, tau') + 8 Qd J Qd^T q ]
//   [  2 q^T      0  ] [ lambda ] = [        -2 |dq/dt|^2           ]
// `baumgarte_rate` r >= 0 (1/s) adds -2 r d/dt(e) - r^2 e, e = q^T q - 1, to the last row.
Eigen::Vector4d quaternion_acceleration(const Eigen::Matrix3d& inertia, const Quaternion& q,
                                        const Eigen::Vector4d& q_dot,
                                        const Eigen::Vector3d& torque_body, double baumgarte_rate);

}  // namespace walktrack
