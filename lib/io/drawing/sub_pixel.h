// Positions between pixels, for OpenCV's drawing functions with their argument `shift`.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <opencv2/core/types.hpp>

namespace walktrack {
inline namespace io {

inline constexpr int kFractionBits = 4;

// In units of 2^-kFractionBits px. Positions far outside any image are clamped, because OpenCV's
// coordinates would overflow.
inline cv::Point fixed_point(const Eigen::Vector2d& place_px) {
  const auto fixed = [](double v) {
    return static_cast<int>(std::lround(std::clamp(v, -1e5, 1e5) * (1 << kFractionBits)));
  };
  return {fixed(place_px.x()), fixed(place_px.y())};
}

}  // namespace io
}  // namespace walktrack
