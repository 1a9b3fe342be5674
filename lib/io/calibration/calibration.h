// Calibration files of cameras, in the file's own axes (metres, x_camera = R x + t).
//
// The formats of OpenCV, Pose2Sim and Anipose, Tsai, Qualisys, Vicon, EasyMocap, OpenCap and
// HumanEva are described in formats/<tool>.h. `file` is the name in messages.
//
// All readers throw InputError naming file, line where the format has lines, key, what was found
// and what is allowed. A rotation may be rounded (kRotationTolerance) and is made exact.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/calibration/calibration_checks.h"

namespace walktrack {
inline namespace io {

// Reads the camera called `name`, which selects one in files with several cameras. `size`: of the
// images, for files that do not state it.
Camera read_calibration(const std::filesystem::path& path, const std::string& name,
                        const std::optional<ImageSize>& size = std::nullopt);

// The cameras of a file with several, in its order; empty for a file with one camera.
std::vector<std::string> calibration_names(const std::filesystem::path& path);

}  // namespace io
}  // namespace walktrack
