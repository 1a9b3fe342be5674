// Articulated bodies in 3-D: a tree of rigid parts, the root free, the others on hinge, ball or
// fixed joints. World axes are inertial, z up by convention only (gravity is an argument).
//
// A part's frame has its origin at the joint to its parent. Coordinates:
//   q: root origin (3, world), root quaternion world_from_root (4), then per part in order: hinge 1
//      angle, ball a quaternion (4, joint rotation), fixed nothing;
//   u: velocity of the root origin (3, world), omega of the root (3, root axes), then per part:
//      hinge 1 rate, ball 3 (relative angular velocity in the child's axes), fixed nothing.
// Generalised forces tau are dual to u: u^T tau is power.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "mechanics/mass_properties.h"
#include "mechanics/quaternion.h"

namespace walktrack {
inline namespace mechanics {

enum class JointKind { kHinge, kBall, kFixed };

struct ArticulatedPart {
  MassProperties mass;                               // in the part's frame
  int parent = -1;                                   // index of an earlier part; -1 for the root
  JointKind joint = JointKind::kFixed;               // ignored for the root
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();  // joint in the parent's frame, m
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();   // hinge axis, unit, part's frame
  Quaternion rest = identity_quaternion();           // parent_from_part with the joint at zero
};

// Part 0 is the root; parents come before their children.
class ArticulatedBody {
 public:
  // Throws std::invalid_argument if the tree is not ordered or a hinge axis is not of unit length.
  explicit ArticulatedBody(std::vector<ArticulatedPart> parts);

  const std::vector<ArticulatedPart>& parts() const { return parts_; }
  Eigen::Index positions() const { return positions_; }    // size of q
  Eigen::Index velocities() const { return velocities_; }  // size of u
  Eigen::Index position_index(size_t part) const { return position_index_[part]; }
  Eigen::Index velocity_index(size_t part) const { return velocity_index_[part]; }
  double mass() const { return mass_; }

  // All joints at zero, root at the origin.
  Eigen::VectorXd zero_positions() const;
  // dq/dt
  Eigen::VectorXd position_rate(const Eigen::VectorXd& q, const Eigen::VectorXd& u) const;
  // q moved along u for unit time, quaternions by the exponential map.
  Eigen::VectorXd advanced(const Eigen::VectorXd& q, const Eigen::VectorXd& u) const;
  // q with unit quaternions.
  Eigen::VectorXd with_unit_quaternions(Eigen::VectorXd q) const;

 private:
  std::vector<ArticulatedPart> parts_;
  std::vector<Eigen::Index> position_index_, velocity_index_;
  Eigen::Index positions_ = 7, velocities_ = 6;
  double mass_ = 0;
};

// The pose and motion of a part, in world axes at the part's origin. The accelerations are the
// convective ones (u_dot = 0) unless stated otherwise.
struct PartMotion {
  Eigen::Vector3d origin, velocity, acceleration;
  Eigen::Matrix3d rotation;  // world_from_part
  Eigen::Vector3d omega, alpha;
};

// Motion of every part for given u_dot (zero: convective accelerations).
std::vector<PartMotion> part_motions(const ArticulatedBody& body, const Eigen::VectorXd& q,
                                     const Eigen::VectorXd& u, const Eigen::VectorXd& u_dot);

Eigen::Vector3d point_position(const PartMotion& part, const Eigen::Vector3d& point);
Eigen::Vector3d point_velocity(const PartMotion& part, const Eigen::Vector3d& point);
Eigen::Vector3d point_acceleration(const PartMotion& part, const Eigen::Vector3d& point);

// d(velocity of a point of a part)/du and d(omega of a part)/du, world axes, 3 x n.
Eigen::Matrix3Xd point_jacobian(const ArticulatedBody& body, const std::vector<PartMotion>& motions,
                                size_t part, const Eigen::Vector3d& point);
Eigen::Matrix3Xd rotation_jacobian(const ArticulatedBody& body,
                                   const std::vector<PartMotion>& motions, size_t part);

struct BodyMomentum {
  Eigen::Vector3d com, linear, angular;  // angular about the centre of mass; world axes
  double kinetic_energy = 0;             // J
};
BodyMomentum body_momentum(const ArticulatedBody& body, const Eigen::VectorXd& q,
                           const Eigen::VectorXd& u);

}  // namespace mechanics
}  // namespace walktrack
