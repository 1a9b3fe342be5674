// Optical flow without measuring it: how well two frames agree along the motion of a pose.
//
// A material point of the visible surface is at pixel u now and, says the pose, was at w one frame
// ago. If that is so, both pixels look alike; if the point is resting background, u looked alike
// then. With the residuals m = I(u) - J(w) and r = I(u) - J(u) of the grey images I (now) and J
// (before), both of variance s^2,
//   log ratio = -(dof + 1)/2 [ log(1 + m^2 / (dof s^2)) - log(1 + r^2 / (dof s^2)) ],
//   s^2 = noise^2 + error_px^2 |grad I|^2.
// It is zero for a body at rest, where nothing has texture and for a point that is not seen, so
// poses with different visible points stay comparable. What measured flow gets wrong at the very
// places that matter (README.md, Flow) no particle needs: each brings its own motion along.
#pragma once

#include <cstdint>
#include <vector>

#include "observation/capsules.h"
#include "observation/config.h"
#include "observation/planes.h"

namespace cv {
class Mat;
}

namespace walktrack {

struct FlowPixel {
  float now = 0, before = 0;  // smoothed grey levels
  float precision = 0;        // 1 / s^2; 0 = an occluder stands here, nothing is known
};

// Two successive frames around a walker, row by row.
struct FlowField {
  PixelRect area;
  std::vector<FlowPixel> pixels;  // none when there is no frame before

  const FlowPixel& at(int x, int y) const {
    return pixels[static_cast<size_t>(y - area.y0) * static_cast<size_t>(area.width()) +
                  static_cast<size_t>(x - area.x0)];
  }
};

struct GreyImage {
  int width = 0, height = 0;
  std::vector<uint8_t> pixels;  // row by row
};

// `before` and `now`: 8-bit grey images of one size. Holds `area` and some pixels more to all
// sides, from which a walker in it may have come.
void pair_frames(const FlowConfig& config, const cv::Mat& before, const cv::Mat& now,
                 const PixelRect& area, FlowField& out);
void pair_frames(const FlowConfig& config, const GreyImage& before, const GreyImage& now,
                 const PixelRect& area, FlowField& out);

// Sum over points of the visible surface, nats times square pixels: each point weighs as much as
// the area it stands for. `now` and `before` are the capsules of one particle in this and the
// previous frame.
double flow_log_ratio(const FlowConfig& config, const FlowField& flow, const CapsuleList& now,
                      const CapsuleList& before);

}  // namespace walktrack
