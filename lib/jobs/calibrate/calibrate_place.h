// The place of a camera from points on the ground or on a board.
#pragma once

#include <string>

#include "io/calibration/measured_points.h"
#include "observation/calibration/camera_fit.h"

namespace walktrack {
inline namespace jobs {

// The camera's pose from points. Throws an InputError for mirrored axes, a camera below the ground,
// and points that do not fit, naming the worst one. `file` and `lines` name the points in messages.
PlaceFit checked_place(const Camera& lens, const MeasuredPoints& points, const std::string& file);

}  // namespace jobs
}  // namespace walktrack
