#include "mechanics/articulated.h"

#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>

namespace walktrack {
inline namespace mechanics {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Index position_count(JointKind kind) {
  return kind == JointKind::kHinge ? 1 : kind == JointKind::kBall ? 4 : 0;
}

Index velocity_count(JointKind kind) {
  return kind == JointKind::kHinge ? 1 : kind == JointKind::kBall ? 3 : 0;
}

// The vector of a joint's relative angular rates (or accelerations) in the child's axes.
Vector3d joint_vector(const ArticulatedPart& part, const VectorXd& u, Index at) {
  switch (part.joint) {
    case JointKind::kHinge:
      return part.axis * u(at);
    case JointKind::kBall:
      return u.segment<3>(at);
    case JointKind::kFixed:
      break;
  }
  return Vector3d::Zero();
}

Matrix3d joint_rotation(const ArticulatedPart& part, const VectorXd& q, Index at) {
  switch (part.joint) {
    case JointKind::kHinge:
      return Eigen::AngleAxisd(q(at), part.axis).toRotationMatrix();
    case JointKind::kBall:
      return rotation_matrix(q.segment<4>(at));
    case JointKind::kFixed:
      break;
  }
  return Matrix3d::Identity();
}

PartMotion root_motion(const VectorXd& q, const VectorXd& u, const VectorXd& u_dot) {
  PartMotion root;
  root.origin = q.head<3>();
  root.rotation = rotation_matrix(q.segment<4>(3));
  root.velocity = u.head<3>();
  root.omega = root.rotation * u.segment<3>(3);
  root.acceleration = u_dot.head<3>();
  root.alpha = root.rotation * u_dot.segment<3>(3);  // d(R omega')/dt = R d(omega')/dt
  return root;
}

PartMotion child_motion(const ArticulatedPart& part, const PartMotion& parent,
                        const Matrix3d& rotation, const Vector3d& rate, const Vector3d& rate_dot) {
  PartMotion child;
  child.origin = point_position(parent, part.anchor);
  child.velocity = point_velocity(parent, part.anchor);
  child.acceleration = point_acceleration(parent, part.anchor);
  child.rotation = parent.rotation * rotation_matrix(part.rest) * rotation;
  const Vector3d relative = child.rotation * rate;
  child.omega = parent.omega + relative;
  child.alpha = parent.alpha + parent.omega.cross(relative) + child.rotation * rate_dot;
  return child;
}

}  // namespace

ArticulatedBody::ArticulatedBody(std::vector<ArticulatedPart> parts) : parts_(std::move(parts)) {
  if (parts_.empty() || parts_[0].parent != -1) {
    throw std::invalid_argument("articulated body: part 0 must be the root");
  }
  for (size_t i = 0; i < parts_.size(); ++i) {
    const ArticulatedPart& part = parts_[i];
    mass_ += part.mass.mass;
    position_index_.push_back(i == 0 ? 0 : positions_);
    velocity_index_.push_back(i == 0 ? 0 : velocities_);
    if (i == 0) continue;
    if (part.parent < 0 || static_cast<size_t>(part.parent) >= i) {
      throw std::invalid_argument("articulated body: parents must come before their children");
    }
    if (part.joint == JointKind::kHinge && std::abs(part.axis.norm() - 1) > 1e-9) {
      throw std::invalid_argument("articulated body: a hinge axis must have unit length");
    }
    positions_ += position_count(part.joint);
    velocities_ += velocity_count(part.joint);
  }
}

VectorXd ArticulatedBody::zero_positions() const {
  return with_unit_quaternions(VectorXd::Zero(positions_));
}

VectorXd ArticulatedBody::position_rate(const VectorXd& q, const VectorXd& u) const {
  VectorXd rate(positions_);
  rate.head<3>() = u.head<3>();
  rate.segment<4>(3) = quaternion_rate(q.segment<4>(3), u.segment<3>(3));
  for (size_t i = 1; i < parts_.size(); ++i) {
    const Index p = position_index_[i], v = velocity_index_[i];
    if (parts_[i].joint == JointKind::kHinge) rate(p) = u(v);
    if (parts_[i].joint == JointKind::kBall) {
      rate.segment<4>(p) = quaternion_rate(q.segment<4>(p), u.segment<3>(v));
    }
  }
  return rate;
}

VectorXd ArticulatedBody::advanced(const VectorXd& q, const VectorXd& u) const {
  VectorXd next = q;
  next.head<3>() += u.head<3>();
  next.segment<4>(3) = product(q.segment<4>(3), quaternion_from_vector(u.segment<3>(3)));
  for (size_t i = 1; i < parts_.size(); ++i) {
    const Index p = position_index_[i], v = velocity_index_[i];
    if (parts_[i].joint == JointKind::kHinge) next(p) += u(v);
    if (parts_[i].joint == JointKind::kBall) {
      next.segment<4>(p) = product(q.segment<4>(p), quaternion_from_vector(u.segment<3>(v)));
    }
  }
  return next;
}

VectorXd ArticulatedBody::with_unit_quaternions(VectorXd q) const {
  q.segment<4>(3) = normalised(q.segment<4>(3));
  for (size_t i = 1; i < parts_.size(); ++i) {
    if (parts_[i].joint != JointKind::kBall) continue;
    q.segment<4>(position_index_[i]) = normalised(q.segment<4>(position_index_[i]));
  }
  return q;
}

std::vector<PartMotion> part_motions(const ArticulatedBody& body, const VectorXd& q,
                                     const VectorXd& u, const VectorXd& u_dot) {
  const auto& parts = body.parts();
  std::vector<PartMotion> motions{root_motion(q, u, u_dot)};
  for (size_t i = 1; i < parts.size(); ++i) {
    const Index v = body.velocity_index(i);
    motions.push_back(child_motion(parts[i], motions[static_cast<size_t>(parts[i].parent)],
                                   joint_rotation(parts[i], q, body.position_index(i)),
                                   joint_vector(parts[i], u, v), joint_vector(parts[i], u_dot, v)));
  }
  return motions;
}

Vector3d point_position(const PartMotion& part, const Vector3d& point) {
  return part.origin + part.rotation * point;
}

Vector3d point_velocity(const PartMotion& part, const Vector3d& point) {
  return part.velocity + part.omega.cross(part.rotation * point);
}

Vector3d point_acceleration(const PartMotion& part, const Vector3d& point) {
  const Vector3d r = part.rotation * point;
  return part.acceleration + part.alpha.cross(r) + part.omega.cross(part.omega.cross(r));
}

Matrix3Xd rotation_jacobian(const ArticulatedBody& body, const std::vector<PartMotion>& motions,
                            size_t part) {
  Matrix3Xd jacobian = Matrix3Xd::Zero(3, body.velocities());
  for (size_t i = part; i > 0; i = static_cast<size_t>(body.parts()[i].parent)) {
    const Index v = body.velocity_index(i);
    const ArticulatedPart& link = body.parts()[i];
    if (link.joint == JointKind::kHinge) jacobian.col(v) = motions[i].rotation * link.axis;
    if (link.joint == JointKind::kBall) jacobian.middleCols<3>(v) = motions[i].rotation;
  }
  jacobian.middleCols<3>(3) = motions[0].rotation;
  return jacobian;
}

Matrix3Xd point_jacobian(const ArticulatedBody& body, const std::vector<PartMotion>& motions,
                         size_t part, const Vector3d& point) {
  // A rotation at a joint moves the point by axis x (point - joint).
  Matrix3Xd jacobian = rotation_jacobian(body, motions, part);
  const Vector3d x = point_position(motions[part], point);
  for (size_t i = part;; i = static_cast<size_t>(body.parts()[i].parent)) {
    const Vector3d arm = x - motions[i].origin;
    const Index v = i == 0 ? 3 : body.velocity_index(i);
    const Index count = i == 0 ? 3 : velocity_count(body.parts()[i].joint);
    for (Index k = v; k < v + count; ++k) jacobian.col(k) = jacobian.col(k).cross(arm).eval();
    if (i == 0) break;
  }
  jacobian.leftCols<3>() = Matrix3d::Identity();
  return jacobian;
}

BodyMomentum body_momentum(const ArticulatedBody& body, const VectorXd& q, const VectorXd& u) {
  const auto motions = part_motions(body, q, u, VectorXd::Zero(body.velocities()));
  BodyMomentum sum{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), 0};
  for (size_t i = 0; i < motions.size(); ++i) {
    const MassProperties& mass = body.parts()[i].mass;
    const Vector3d x = point_position(motions[i], mass.com);
    const Vector3d v = point_velocity(motions[i], mass.com);
    const Vector3d spin_body = motions[i].rotation.transpose() * motions[i].omega;
    sum.com += mass.mass * x;
    sum.linear += mass.mass * v;
    sum.angular += mass.mass * x.cross(v) + motions[i].rotation * (mass.inertia * spin_body);
    sum.kinetic_energy +=
        0.5 * mass.mass * v.squaredNorm() + 0.5 * spin_body.dot(mass.inertia * spin_body);
  }
  sum.com /= body.mass();
  sum.angular -= sum.com.cross(sum.linear);
  return sum;
}

}  // namespace mechanics
}  // namespace walktrack
