// Pose2Sim's and Anipose's files (.toml): a table for each camera with name, size, matrix,
// distortions, rotation (Rodrigues), translation, fisheye; the camera is found by its name or its
// table's. Lengths are taken as metres, as Pose2Sim has them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "camera/camera.h"

namespace walktrack {
inline namespace io {

Camera camera_from_toml(const std::string& text, const std::string& file, const std::string& name);
std::vector<std::string> toml_names(const std::string& text, const std::string& file);

// A Pose2Sim file of cameras. Reading it back gives the same cameras up to the rounding of the
// rotation vector.
std::string toml_from_cameras(const std::vector<std::pair<std::string, Camera>>& cameras);

}  // namespace io
}  // namespace walktrack
