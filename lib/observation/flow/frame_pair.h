// Two successive frames of one camera around a few pixels, smoothed, as leg_order.h compares them.
#pragma once

#include <vector>

#include "observation/silhouette/planes.h"

namespace cv {
class Mat;
}

namespace walktrack {
inline namespace observation {

struct GreyImage {
  int width = 0, height = 0;
  std::vector<uint8_t> pixels;  // row by row
};

// The same as OpenCV sees it; it has no view of constant pixels, so nothing may be written.
cv::Mat view_of(const GreyImage& image);

struct PairPixel {
  float now = 0, before = 0;  // smoothed grey levels
  float precision = 0;        // 1 / variance of a difference along a motion; per grey level^2
};

struct FramePair {
  PixelRect area;
  std::vector<PairPixel> pixels;  // row by row

  const PairPixel& at(int x, int y) const {
    return pixels[static_cast<size_t>(y - area.y0) * static_cast<size_t>(area.width()) +
                  static_cast<size_t>(x - area.x0)];
  }
};

// `before` and `now`: of one size. Holds `area` and some pixels more to all sides, from which a
// walker in it may have come; nothing for an empty area.
FramePair pair_frames(const GreyImage& before, const GreyImage& now, const PixelRect& area);

}  // namespace observation
}  // namespace walktrack
