// Qualisys Track Manager's text calibration (.qca.txt), which is XML in spite of its name.
//
// focalLength, centerPoint and distortions are in 64ths of a pixel, as Pose2Sim reads them; lengths
// are in mm. transform contains the camera's position x, y, z and the rotation from the world to
// the camera's axes (x right, y up, z backwards), row by row.
#pragma once

#include <string>
#include <vector>

#include "camera/camera.h"

namespace walktrack {
inline namespace io {

Camera camera_from_qualisys(const std::string& text, const std::string& file,
                            const std::string& name);
std::vector<std::string> qualisys_names(const std::string& text, const std::string& file);

}  // namespace io
}  // namespace walktrack
