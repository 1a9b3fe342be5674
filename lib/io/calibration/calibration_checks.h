// Checks that all calibration readers share.
#pragma once

#include <functional>
#include <string_view>

#include <Eigen/Core>

#include "camera/camera.h"

namespace walktrack {
inline namespace io {

struct ImageSize {
  int width_px, height_px;
};

// Throws the reader's InputError for a key: what was found and what is allowed.
using Complain =
    std::function<void(std::string_view key, std::string_view found, std::string_view allowed)>;

// Sets focal length and principal point from a 3x3 matrix, which must be upper triangular with a
// last row 0 0 1, free of skew, and with positive focal lengths.
void set_camera_matrix(Camera& camera, const Eigen::Matrix3d& matrix, const Complain& complain);

// Allowed deviation of R'R from the identity (largest entry), for rounded digits.
inline constexpr double kRotationTolerance = 1e-3;

// The rotation nearest to a matrix that is a rotation up to rounding, neither scaled nor mirrored.
Eigen::Matrix3d checked_rotation(const Eigen::Matrix3d& matrix, const Complain& complain);

// The rotation by |vector| radians about it (Rodrigues).
Eigen::Matrix3d rotation_from_rodrigues(const Eigen::Vector3d& vector);

inline constexpr int kMostPixels = 65536;  // along a side of an image

}  // namespace io
}  // namespace walktrack
