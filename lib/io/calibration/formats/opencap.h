// OpenCap's cameraIntrinsicsExtrinsics.pickle (opencap-core, utils.py, saveCameraParameters) is a
// dictionary with imageSize (height, width), intrinsicMat, distortion, rotation and translation
// (mm), x_camera = R x + t. Its axes are those of the calibration board: x along its rows, y along
// its columns. If the board lay on the floor, z points down; if it stood against a wall, y does.
#pragma once

#include <string>

#include "camera/camera.h"

namespace walktrack {
inline namespace io {

Camera camera_from_opencap(const std::string& bytes, const std::string& file);

}  // namespace io
}  // namespace walktrack
