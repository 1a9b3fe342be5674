#include "mechanics/quaternion.h"

#include <cmath>

#include <Eigen/Geometry>

namespace walktrack {
inline namespace mechanics {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;

Quaternion product(const Quaternion& p, const Quaternion& q) { return left_matrix(p) * q; }

Matrix4d left_matrix(const Quaternion& q) {
  Matrix4d left;
  // clang-format off
  left << q(0), -q(1), -q(2), -q(3),
          q(1),  q(0), -q(3),  q(2),
          q(2),  q(3),  q(0), -q(1),
          q(3), -q(2),  q(1),  q(0);
  // clang-format on
  return left;
}

Quaternion normalised(const Quaternion& q) {
  const double norm = q.norm();
  return norm > 0 ? Quaternion(q / norm) : identity_quaternion();
}

Matrix3d rotation_matrix(const Quaternion& q) {
  const Quaternion unit = normalised(q);
  return Eigen::Quaterniond(unit(0), unit(1), unit(2), unit(3)).toRotationMatrix();
}

Quaternion quaternion_from_rotation(const Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  const Quaternion result(q.w(), q.x(), q.y(), q.z());
  return result(0) < 0 ? Quaternion(-result) : result;
}

Quaternion quaternion_from_vector(const Vector3d& v) {
  const double angle = v.norm();
  // sin(angle / 2) / angle, by its Taylor series near 0.
  const double factor = angle > 1e-8 ? std::sin(angle / 2) / angle : 0.5 - angle * angle / 48.0;
  Quaternion q;
  q << std::cos(angle / 2), factor * v;
  return q;
}

Quaternion quaternion_rate(const Quaternion& q, const Vector3d& omega_body) {
  Quaternion pure;
  pure << 0, omega_body;
  return 0.5 * product(q, pure);
}

}  // namespace mechanics
}  // namespace walktrack
