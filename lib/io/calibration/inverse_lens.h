// Converts a lens model that corrects distortion into Brown's model, which describes the distortion
// itself.
#pragma once

#include <functional>

#include <Eigen/Core>

#include "camera/camera.h"
#include "io/calibration/calibration_checks.h"

namespace walktrack {
inline namespace io {

inline constexpr double kMostLensMisfit = 0.5;  // px

// Sets k1 k2 p1 p2 k3 of a camera whose size, focal length and principal point are set, by least
// squares over the image. `straight` returns for a pixel its position in an image without
// distortion. If Brown's model deviates by more than kMostLensMisfit, `complain` is called with
// `key`.
void set_inverse_distortion(Camera& camera,
                            const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& straight,
                            const char* key, const Complain& complain);

}  // namespace io
}  // namespace walktrack
