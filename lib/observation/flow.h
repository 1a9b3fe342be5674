// Optical flow: what moved where between two frames, and how well a pose explains it.
//
// Measured flow d (px, from the frame before to this one, at pixels of this one) comes with a
// precision matrix L: large along directions in which the patch has texture, nothing along the
// others (the aperture problem). A material point that the pose moves by p is compared with the
// same pixel seen as resting background; e = d - p,
//   log ratio = -(dof + 2)/2 [ log(1 + e'Le / dof) - log(1 + d'Ld / dof) ].
// It is zero for a body at rest, for a point without texture and for one that is not seen, so poses
// with different visible points stay comparable.
#pragma once

#include <vector>

#include "observation/capsules.h"
#include "observation/config.h"
#include "observation/planes.h"

namespace cv {
class Mat;
}

namespace walktrack {

struct FlowSample {
  float dx = 0, dy = 0;             // px since the frame before
  float lxx = 0, lxy = 0, lyy = 0;  // precision, 1 / px^2
};

// A grid of samples: cell (i, j) covers step x step pixels from area.x0 + i step on.
struct FlowField {
  PixelRect area;
  int step = 1, columns = 0, rows = 0;
  std::vector<FlowSample> samples;  // columns a row; none when there is no frame before

  const FlowSample* at(double x, double y) const {
    const double i = (x + 0.5 - area.x0) / step, j = (y + 0.5 - area.y0) / step;
    if (!(i >= 0 && j >= 0 && i < columns && j < rows)) return nullptr;
    return &samples[static_cast<size_t>(j) * static_cast<size_t>(columns) + static_cast<size_t>(i)];
  }
};

// Flow from `before` to `now`, 8-bit grey images of one size, inside `area`.
void measure_flow(const FlowConfig& config, const cv::Mat& before, const cv::Mat& now,
                  const PixelRect& area, FlowField& out);

// Sum over points of the visible surface, nats times square pixels: each point weighs as much as
// the area it stands for. `now` and `before` are the capsules of one particle in this and the
// previous frame.
double flow_log_ratio(const FlowConfig& config, const FlowField& flow, const CapsuleList& now,
                      const CapsuleList& before);

}  // namespace walktrack
