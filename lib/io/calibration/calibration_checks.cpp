#include "io/calibration/calibration_checks.h"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/dense.h"

namespace walktrack {
inline namespace io {

void set_camera_matrix(Camera& camera, const Eigen::Matrix3d& matrix, const Complain& complain) {
  const bool last_row = matrix(2, 0) == 0 && matrix(2, 1) == 0 && matrix(2, 2) == 1;
  if (!last_row || matrix(1, 0) != 0) {
    const bool transposed = matrix(0, 2) == 0 && matrix(1, 2) == 0 && matrix(2, 2) == 1;
    complain("camera_matrix", transposed ? "a transposed matrix" : "a matrix of another form",
             "[fx 0 cx; 0 fy cy; 0 0 1]");
  }
  if (matrix(0, 1) != 0) {
    complain("camera_matrix", fmt::format("a skew of {:g}", matrix(0, 1)), "cameras without skew");
  }
  if (!(matrix(0, 0) > 0 && matrix(1, 1) > 0)) {
    complain("camera_matrix", fmt::format("focal lengths {:g}, {:g}", matrix(0, 0), matrix(1, 1)),
             "positive focal lengths, px");
  }
  camera.focal_px = {matrix(0, 0), matrix(1, 1)};
  camera.centre_px = {matrix(0, 2), matrix(1, 2)};
}

Eigen::Matrix3d checked_rotation(const Eigen::Matrix3d& matrix, const Complain& complain) {
  const double scale = std::cbrt(std::abs(matrix.determinant()));
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const double error = (matrix.transpose() * matrix - identity).cwiseAbs().maxCoeff();
  if (!(error <= kRotationTolerance)) {
    const bool scaled =
        (matrix.transpose() * matrix / (scale * scale) - identity).cwiseAbs().maxCoeff() <=
        kRotationTolerance;
    complain("rotation",
             scaled
                 ? fmt::format("a rotation scaled by {:g}", scale)
                 : fmt::format(
                       "a matrix that is not a rotation (R'R differs from the identity by {:.2g})",
                       error),
             "an orthonormal 3x3 matrix or a Rodrigues vector");
  }
  if (matrix.determinant() < 0) {
    complain("rotation", "a mirrored matrix (determinant -1)",
             "a rotation; one axis has the wrong sign, or the world axes are left-handed");
  }
  constexpr double kExact = 1e-9;
  if (error < kExact) return matrix;
  // the nearest rotation: R (R'R)^-1/2 (Higham 1986)
  const auto [values, axes] = symmetric_eigen(matrix.transpose() * matrix);
  return matrix * (axes * values.cwiseSqrt().cwiseInverse().asDiagonal() * axes.transpose());
}

Eigen::Matrix3d rotation_from_rodrigues(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

}  // namespace io
}  // namespace walktrack
