// Right-handed axes of a segment from two directions: x forward, y left, z up.
#pragma once

#include <Eigen/Geometry>

namespace walktrack {
inline namespace body {

// Columns x, y, z: z along `up`, y as near to `left` as possible.
inline Eigen::Matrix3d axes_with_z(const Eigen::Vector3d& up, const Eigen::Vector3d& left) {
  Eigen::Matrix3d out;
  out.col(2) = up.normalized();
  out.col(1) = (left - out.col(2) * out.col(2).dot(left)).normalized();
  out.col(0) = out.col(1).cross(out.col(2));
  return out;
}

// The same with x along `forward`, for feet.
inline Eigen::Matrix3d axes_with_x(const Eigen::Vector3d& forward, const Eigen::Vector3d& left) {
  Eigen::Matrix3d out;
  out.col(0) = forward.normalized();
  out.col(1) = (left - out.col(0) * out.col(0).dot(left)).normalized();
  out.col(2) = out.col(0).cross(out.col(1));
  return out;
}

}  // namespace body
}  // namespace walktrack
