#include "mechanics/articulated_dynamics.h"

#include <Eigen/Geometry>

namespace walktrack {
inline namespace mechanics {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Index spatial_row(size_t part) { return 6 * static_cast<Index>(part); }

Matrix3d world_inertia(const ArticulatedPart& part, const PartMotion& motion) {
  return motion.rotation * part.mass.inertia * motion.rotation.transpose();
}

// Forces of the load on the parts' generalised coordinates, T^T f of the applied forces alone.
VectorXd applied_forces(const ArticulatedBody& body, const std::vector<PartMotion>& motions,
                        const BodyLoad& load) {
  VectorXd tau =
      load.joint_forces.size() > 0 ? load.joint_forces : VectorXd::Zero(body.velocities());
  for (const PartForce& applied : load.forces) {
    tau += point_jacobian(body, motions, applied.part, applied.point).transpose() * applied.force +
           rotation_jacobian(body, motions, applied.part).transpose() * applied.torque;
  }
  return tau;
}

TmtSystem assemble_from(const ArticulatedBody& body, const std::vector<PartMotion>& motions,
                        const BodyLoad& load) {
  const auto& parts = body.parts();
  const Index rows = spatial_row(parts.size());
  MatrixXd mass = MatrixXd::Zero(rows, rows), T(rows, body.velocities());
  VectorXd convective(rows), force(rows);
  for (size_t i = 0; i < parts.size(); ++i) {
    const Index r = spatial_row(i);
    const Matrix3d inertia = world_inertia(parts[i], motions[i]);
    mass.block<3, 3>(r, r) = parts[i].mass.mass * Matrix3d::Identity();
    mass.block<3, 3>(r + 3, r + 3) = inertia;
    T.middleRows<3>(r) = point_jacobian(body, motions, i, parts[i].mass.com);
    T.middleRows<3>(r + 3) = rotation_jacobian(body, motions, i);
    convective.segment<3>(r) = point_acceleration(motions[i], parts[i].mass.com);
    convective.segment<3>(r + 3) = motions[i].alpha;
    force.segment<3>(r) = parts[i].mass.mass * load.gravity;
    force.segment<3>(r + 3) = -motions[i].omega.cross(inertia * motions[i].omega);
  }
  TmtSystem system = assemble_tmt(mass, T, convective, force);
  system.force += applied_forces(body, motions, load);
  return system;
}

Constraint constraint_from(const ArticulatedBody& body, const std::vector<PartMotion>& motions,
                           std::span<const Attachment> attachments) {
  const Index rows = 3 * static_cast<Index>(attachments.size());
  Constraint constraint{VectorXd(rows), MatrixXd(rows, body.velocities()), VectorXd(rows)};
  for (size_t i = 0; i < attachments.size(); ++i) {
    const Attachment& held = attachments[i];
    const PartMotion& part = motions[held.part];
    const Index r = 3 * static_cast<Index>(i);
    constraint.value.segment<3>(r) = point_position(part, held.point) - held.target;
    constraint.jacobian.middleRows<3>(r) = point_jacobian(body, motions, held.part, held.point);
    constraint.convective.segment<3>(r) = point_acceleration(part, held.point);
  }
  return constraint;
}

std::vector<PartMotion> convective_motions(const ArticulatedBody& body, const VectorXd& q,
                                           const VectorXd& u) {
  return part_motions(body, q, u, VectorXd::Zero(body.velocities()));
}

void project(const ArticulatedBody& body, std::span<const Attachment> attachments,
             ArticulatedState& state) {
  // The drift of one step is small: the second Newton step already reaches rounding.
  constexpr int kNewtonSteps = 3;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const TmtSystem system = assemble(body, state.q, state.u, {});
    const Constraint held = attachment_constraint(body, state.q, state.u, attachments);
    state.q = body.advanced(state.q, position_correction(system.mass, held));
  }
  const TmtSystem system = assemble(body, state.q, state.u, {});
  state.u = projected_velocity(system.mass,
                               attachment_constraint(body, state.q, state.u, attachments), state.u);
}

}  // namespace

TmtSystem assemble(const ArticulatedBody& body, const VectorXd& q, const VectorXd& u,
                   const BodyLoad& load) {
  return assemble_from(body, convective_motions(body, q, u), load);
}

Constraint attachment_constraint(const ArticulatedBody& body, const VectorXd& q, const VectorXd& u,
                                 std::span<const Attachment> attachments) {
  return constraint_from(body, convective_motions(body, q, u), attachments);
}

ForwardDynamics forward_dynamics(const ArticulatedBody& body, const VectorXd& q, const VectorXd& u,
                                 const BodyLoad& load, std::span<const Attachment> attachments,
                                 double baumgarte_rate) {
  const auto motions = convective_motions(body, q, u);
  const TmtSystem system = assemble_from(body, motions, load);
  if (attachments.empty()) return {solve_mass(system.mass, system.force), {}};
  const ConstrainedMotion motion = solve_augmented(
      system.mass, system.force, constraint_from(body, motions, attachments), u, baumgarte_rate);
  ForwardDynamics result{motion.acceleration, {}};
  for (size_t i = 0; i < attachments.size(); ++i) {
    result.attachment_forces.push_back(-motion.multipliers.segment<3>(3 * static_cast<Index>(i)));
  }
  return result;
}

InverseDynamics inverse_dynamics(const ArticulatedBody& body, const VectorXd& q, const VectorXd& u,
                                 const VectorXd& u_dot, const BodyLoad& load) {
  const auto& parts = body.parts();
  const auto motions = part_motions(body, q, u, u_dot);
  InverseDynamics result{VectorXd::Zero(body.velocities()),
                         std::vector<Vector3d>(parts.size(), Vector3d::Zero()),
                         std::vector<Vector3d>(parts.size(), Vector3d::Zero())};
  for (const PartForce& applied : load.forces) {
    const Vector3d arm = motions[applied.part].rotation * applied.point;
    result.joint_force[applied.part] -= applied.force;
    result.joint_moment[applied.part] -= applied.torque + arm.cross(applied.force);
  }
  // From the leaves to the root: forces on a part act on its parent in the opposite direction.
  for (size_t i = parts.size(); i-- > 0;) {
    const MassProperties& mass = parts[i].mass;
    const Vector3d arm = motions[i].rotation * mass.com;
    const Matrix3d inertia = world_inertia(parts[i], motions[i]);
    const Vector3d inertial = mass.mass * (point_acceleration(motions[i], mass.com) - load.gravity);
    result.joint_force[i] += inertial;
    result.joint_moment[i] += inertia * motions[i].alpha +
                              motions[i].omega.cross(inertia * motions[i].omega) +
                              arm.cross(inertial);
    if (i == 0) break;
    const auto parent = static_cast<size_t>(parts[i].parent);
    result.joint_force[parent] += result.joint_force[i];
    result.joint_moment[parent] +=
        result.joint_moment[i] +
        (motions[i].origin - motions[parent].origin).cross(result.joint_force[i]);
  }
  result.tau.head<3>() = result.joint_force[0];
  result.tau.segment<3>(3) = motions[0].rotation.transpose() * result.joint_moment[0];
  for (size_t i = 1; i < parts.size(); ++i) {
    const Vector3d local = motions[i].rotation.transpose() * result.joint_moment[i];
    const Index v = body.velocity_index(i);
    if (parts[i].joint == JointKind::kHinge) result.tau(v) = parts[i].axis.dot(local);
    if (parts[i].joint == JointKind::kBall) result.tau.segment<3>(v) = local;
  }
  return result;
}

std::optional<ArticulatedState> step(const ArticulatedBody& body, const ArticulatedState& state,
                                     const BodyLoad& load, std::span<const Attachment> attachments,
                                     double dt, const ArticulatedStepOptions& options) {
  const Index n = body.positions(), m = body.velocities();
  const double rate =
      options.stabilisation == Stabilisation::kBaumgarte ? options.baumgarte_rate : 0.0;
  const Derivative derivative = [&](double, const VectorXd& y) {
    const VectorXd q = y.head(n), u = y.tail(m);
    VectorXd y_dot(n + m);
    y_dot << body.position_rate(q, u), forward_dynamics(body, q, u, load, attachments, rate).u_dot;
    return y_dot;
  };
  VectorXd y(n + m);
  y << state.q, state.u;
  const auto next = integrate_step(options.integrator, derivative, 0, dt, y);
  if (!next) return std::nullopt;
  ArticulatedState result{body.with_unit_quaternions(next->head(n)), next->tail(m)};
  if (options.stabilisation == Stabilisation::kProjection && !attachments.empty()) {
    project(body, attachments, result);
    if (!result.q.allFinite() || !result.u.allFinite()) return std::nullopt;
  }
  return result;
}

}  // namespace mechanics
}  // namespace walktrack
