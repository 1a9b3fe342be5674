// OpenCV's files (.yaml .yml .json): image_width image_height camera_matrix distortion_coefficients
// rotation (3x3 or Rodrigues vector) translation, and optionally fisheye; matrices as OpenCV writes
// them or as plain lists; other keys are ignored.
#pragma once

#include <string>

#include "camera/camera.h"

namespace walktrack {
inline namespace io {

Camera camera_from_opencv(const std::string& text, const std::string& file);

// The OpenCV file of a camera; reading it back gives the same camera, bit for bit.
std::string opencv_from_camera(const Camera& camera);

}  // namespace io
}  // namespace walktrack
