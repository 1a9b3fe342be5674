// Smoothed parts of two successive frames of one camera, which leg_order.h compares.
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

// An OpenCV view of the image. OpenCV has no view of constant pixels; nothing may be written.
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

// `before` and `now`: of one size. Contains `area` and a margin from which the subject's pixels may
// have come; empty for an area that is empty or far outside the images.
FramePair pair_frames(const GreyImage& before, const GreyImage& now, const PixelRect& area);

}  // namespace observation
}  // namespace walktrack
