// HumanEva's .cal file has 22 numbers, in the order of its toolbox (Sigal, ReadSpicaCalib.m, 2006):
// focal length (2, px), principal point (2, px), skew, distortion (5: k1 k2 p1 p2 k3, as in
// OpenCV), rotation (9, row by row) and translation (3, mm) with x_camera = R x_world + T. It does
// not contain the size of the images.
#pragma once

#include <optional>
#include <string>

#include "io/calibration/calibration_checks.h"

namespace walktrack {
inline namespace io {

// `size`: of the images.
Camera camera_from_humaneva(const std::string& text, const std::string& file,
                            const std::optional<ImageSize>& size = std::nullopt);

}  // namespace io
}  // namespace walktrack
