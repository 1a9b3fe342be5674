// Calibration files of cameras, in the file's own axes (metres, x_camera = R x + t).
//
// OpenCV (.yaml .yml .json): image_width image_height camera_matrix distortion_coefficients
//   rotation (3x3 or Rodrigues vector) translation, and optionally fisheye; matrices as OpenCV
//   writes them or as plain lists; other keys are ignored.
//
// All readers throw InputError naming file, line where the format has lines, key, what was found
// and what is allowed. A rotation may be rounded (kRotationTolerance) and is made exact.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "camera/camera.h"

namespace walktrack {

// Reads the camera called `name` (which matters for files that hold several).
Camera read_calibration(const std::filesystem::path& path, const std::string& name);

// One format each; `file` is what messages call it.
Camera camera_from_opencv(const std::string& text, const std::string& file);

// The OpenCV file of a camera; reading it back gives the same camera, bit for bit.
std::string opencv_from_camera(const Camera& camera);

// How far R'R may be from the identity (largest entry) in a file with rounded digits.
inline constexpr double kRotationTolerance = 1e-3;

}  // namespace walktrack
