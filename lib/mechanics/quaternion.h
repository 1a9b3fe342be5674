// Rotations as unit quaternions, scalar first: q = (w, x, y, z). With q = world_from_body,
//   (0, v_world) = q o (0, v_body) o conj(q),
//   dq/dt = 1/2 (0, omega_world) o q = 1/2 q o (0, omega_body).
// They are plain 4-vectors, because integrators add them; the caller has to normalise afterwards.
#pragma once

#include <Eigen/Core>

namespace walktrack {
inline namespace mechanics {

using Quaternion = Eigen::Vector4d;

inline Quaternion identity_quaternion() { return {1, 0, 0, 0}; }

// p o q: the rotation q followed by p.
Quaternion product(const Quaternion& p, const Quaternion& q);

// Q(q) with Q(q) p = q o p. For a unit q it is orthogonal: Q(q)^T = Q(conj q).
Eigen::Matrix4d left_matrix(const Quaternion& q);

// q / |q|; the identity for q = 0.
Quaternion normalised(const Quaternion& q);

// Rotation matrix of q / |q|.
Eigen::Matrix3d rotation_matrix(const Quaternion& q);

// The quaternion of a rotation matrix, w >= 0.
Quaternion quaternion_from_rotation(const Eigen::Matrix3d& rotation);

// Rotation by |v| about v (exponential map).
Quaternion quaternion_from_vector(const Eigen::Vector3d& v);

// dq/dt for an angular velocity in body axes.
Quaternion quaternion_rate(const Quaternion& q, const Eigen::Vector3d& omega_body);

}  // namespace mechanics
}  // namespace walktrack
