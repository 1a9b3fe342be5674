// Tsai's files (.xml): <Camera> with Geometry, Intrinsic and Extrinsic, millimetres, as of the PETS
// data (Tsai, IEEE J. Robotics and Automation 3(4), 1987). The distortion is turned into OpenCV's
// by a fit over the image.
#pragma once

#include <string>

#include "camera/camera.h"

namespace walktrack {
inline namespace io {

Camera camera_from_tsai(const std::string& text, const std::string& file);

}  // namespace io
}  // namespace walktrack
