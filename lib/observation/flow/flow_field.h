// Two successive frames as the flow term (flow.h) compares them: a lattice of pixels with the log
// densities that do not depend on the pose.
#pragma once

#include <cstddef>
#include <vector>

#include "observation/background/background.h"
#include "observation/flow/frame_pair.h"
#include "observation/observation_config.h"
#include "observation/silhouette/planes.h"

namespace walktrack {
inline namespace observation {

// One pixel of the lattice.
struct FlowCell {
  float now;        // grey level; negative: hidden by an occluder
  float at_rest;    // log p_rest
  float uncovered;  // log p_uncovered - log p_rest
};

// A pixel of the previous frame at the brightness of the present one.
struct EarlierPixel {
  float grey;
  float slope2;  // |grad J|^2, squared grey levels per px^2; negative: hidden by an occluder
};

// Two successive frames around the subject.
struct FlowField {
  PixelRect area;  // pixels of the density
  int step = 1;  // px between the pixels that are used: (area.x0 + column step, area.y0 + row step)
  int columns = 0, rows = 0;
  std::vector<FlowCell> cells;  // row by row; empty if there is no previous frame
  LogRatioPlanes uncovered;     // prefix sums of FlowCell::uncovered, x and y being column and row
  PixelRect known;              // of the previous frame
  std::vector<EarlierPixel> before;  // row by row
};

// Largest number of cells: a figure's silhouette in them fits on the stack.
inline constexpr size_t kMaxFlowCells = 16'384;

// The empty scene, if there is a model of it.
struct FlowBackground {
  const BackgroundModel* model = nullptr;
  double gain = 1;  // brightness now relative to the model
};

// `before` and `now`: of one size; a pixel shows `metres_per_px` of the subject. Reuses the memory
// of `out`; an empty area gives no cells.
void make_flow_field(const ObservationConfig& config, const GreyImage& before, const GreyImage& now,
                     const FlowBackground& background, const PixelRect& area, double metres_per_px,
                     FlowField& out);

// Marks cells as unknown where `blocked` (of a frame's size) is not zero. Needs
// finish_flow_field().
void block(const cv::Mat& blocked, FlowField& field);
// Computes the sums over uncovered pixels: the last step.
void finish_flow_field(FlowField& field);

// Brightness of `now` relative to `before`: the median over points of the image.
double light_gain(const GreyImage& before, const GreyImage& now);

// Log of the density of a difference: log_t_peak + dof / 2 log s^2 - (dof + 1) / 2 log(dof s^2 +
// d^2), where d^2 is the difference's square, at most kStrangest s^2: beyond that the tenth of
// pixels with any colour outweighs the Student-t (exactly at s = 1.2 grey levels, elsewhere
// nearly).
inline constexpr float kStrangest = 240;
double log_t_peak(double dof);

}  // namespace observation
}  // namespace walktrack
