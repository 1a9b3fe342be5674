// A lens that is described by how its pictures are put right, as Brown's model, which says how it
// bends them.
#pragma once

#include <functional>

#include <Eigen/Core>

#include "camera/camera.h"
#include "io/calibration/calibration_checks.h"

namespace walktrack {
inline namespace io {

inline constexpr double kMostLensMisfit = 0.5;  // px

// Sets k1 k2 p1 p2 k3 of a camera whose size, focal length and principal point are set, by least
// squares over the picture. `straight` gives for a pixel of the picture the one that a pinhole
// would have there. Where Brown's model misses it by more than kMostLensMisfit, `complain` is told,
// under `key`.
void set_inverse_distortion(Camera& camera,
                            const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& straight,
                            const char* key, const Complain& complain);

}  // namespace io
}  // namespace walktrack
