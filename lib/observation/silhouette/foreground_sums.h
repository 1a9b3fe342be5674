// The evidence for a body in boxes of pixels of one frame: the sum of the log-ratios of all pixels
// that look like some part of it. No figure inside a box can be explained better than by that sum.
#pragma once

#include <span>
#include <vector>

#include "observation/silhouette/planes.h"

namespace walktrack {
inline namespace observation {

class ForegroundSums {
 public:
  // Pixels inside any of the boxes `but` do not count.
  ForegroundSums(const LogRatioPlanes& planes, std::span<const PixelRect> but);

  // Nats, not weighted; pixels outside the planes do not count.
  double within(const PixelRect& box) const;
  double all() const { return within(area_); }

 private:
  PixelRect area_;
  std::vector<double> integral_;  // by row, with a row and a column of zeros first
};

}  // namespace observation
}  // namespace walktrack
