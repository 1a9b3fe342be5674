#include "tests/mechanics/rigid_body.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "mechanics/constraints.h"

namespace walktrack {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;
using Eigen::Vector4d;
using Eigen::VectorXd;

VectorXd packed(const RigidBodyState& state) {
  VectorXd y(13);
  y << state.position, state.orientation, state.velocity, state.omega_body;
  return y;
}

RigidBodyState unpacked(const VectorXd& y) {
  return {y.segment<3>(0), y.segment<4>(3), y.segment<3>(7), y.segment<3>(10)};
}

}  // namespace

Vector3d torque_about(const Vector3d& c, const Vector3d& x, const Vector3d& f) {
  return (x - c).cross(f);
}

Vector3d angular_acceleration(const RigidBody& body, const Vector3d& omega_body,
                              const Vector3d& torque_body) {
  const Vector3d momentum = body.inertia * omega_body;
  return body.inertia.ldlt().solve(torque_body - omega_body.cross(momentum));
}

std::optional<RigidBodyState> step(const RigidBody& body, const RigidBodyState& state,
                                   const LoadLaw& load, double time, double dt,
                                   Integrator integrator) {
  const Derivative derivative = [&](double t, const VectorXd& y) {
    const RigidBodyState now = unpacked(y);
    const RigidBodyLoad applied = load(t, now);
    VectorXd rate(13);
    rate << now.velocity, quaternion_rate(now.orientation, now.omega_body),
        applied.force / body.mass, angular_acceleration(body, now.omega_body, applied.torque_body);
    return rate;
  };
  const auto y = integrate_step(integrator, derivative, time, dt, packed(state));
  if (!y) return std::nullopt;
  RigidBodyState next = unpacked(*y);
  next.orientation = normalised(next.orientation);
  return next;
}

double kinetic_energy(const RigidBody& body, const RigidBodyState& state) {
  return 0.5 * body.mass * state.velocity.squaredNorm() +
         0.5 * state.omega_body.dot(body.inertia * state.omega_body);
}

Vector3d spin_angular_momentum(const RigidBody& body, const RigidBodyState& state) {
  return rotation_matrix(state.orientation) * (body.inertia * state.omega_body);
}

Vector4d quaternion_acceleration(const Matrix3d& inertia, const Quaternion& q,
                                 const Vector4d& q_dot, const Vector3d& torque_body,
                                 double baumgarte_rate) {
  const Matrix4d Q = left_matrix(q);
  const Matrix4d Qd = left_matrix(q_dot);
  Matrix4d J = Matrix4d::Zero();
  J.bottomRightCorner<3, 3>() = inertia;
  Vector4d torque;
  torque << 0, torque_body;
  const Vector4d force = 2 * Q * torque + 8 * Qd * J * Qd.transpose() * q;
  Constraint unit_norm;
  unit_norm.value = VectorXd::Constant(1, q.squaredNorm() - 1);
  unit_norm.jacobian = 2 * q.transpose();
  unit_norm.convective = VectorXd::Constant(1, 2 * q_dot.squaredNorm());
  return solve_augmented(4 * Q * J * Q.transpose(), force, unit_norm, q_dot, baumgarte_rate)
      .acceleration;
}

}  // namespace walktrack
