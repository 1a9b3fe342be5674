// Optical flow without measuring it: the probability of a frame given the previous frame if a body
// has moved from one pose to the other.
//
// With the grey images I (now) and J (before), and the visible silhouette S, every pixel u of the
// frame belongs to one of three kinds:
//   of the body, u in S_now: the same material point was at w in the previous frame. I(u) is
//     Student-t about J(w), or uniform, 1 / 256, if another part hid the point or w is outside the
//     image;
//   uncovered, u in S_before and not in S_now: background that J does not show; I(u) follows the
//     background's model, or is uniform without one;
//   background at rest: I(u) is Student-t about J(u).
// For any two poses this is a normalised density of all pixels that are used, and the term is
//   sum over S_now [log p_body - log p_rest] + sum over S_before \ S_now [log p_uncovered - log
//   p_rest],
// which is zero for a body at rest. The squared scale of the Student-t is noise^2 + (error_px^2 +
// error_share^2 |u - w|^2) |grad J|^2, both for a body at rest and for background. J has been
// scaled to the brightness of I.
//
// Moving things that are not part of the body (arms that it does not have, shadows, people behind)
// must not attract the body: a tenth of the pixels, at rest or of the body, may have any colour,
// which bounds the effect of a single pixel.
//
// The pixels that are used form a lattice with a spacing of a few centimetres on the body, after
// smoothing that matches this spacing, and each represents its area. Measured flow would be wrong
// in exactly the places that matter (reports/flow.md), and it is not needed, because each particle
// has its own motion.
#pragma once

#include <vector>

#include "observation/background/background.h"
#include "observation/flow/frame_pair.h"
#include "observation/observation_config.h"
#include "observation/silhouette/capsules.h"

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

// In nats times square pixels: each cell is weighted by its area. `now` and `before` are the
// capsules of one particle in this and the previous frame.
double flow_log_ratio(const FlowConfig& config, const FlowField& flow, const CapsuleList& now,
                      const CapsuleList& before);

// Log of the density of a difference: log_t_peak + dof / 2 log s^2 - (dof + 1) / 2 log(dof s^2 +
// d^2), where d^2 is the difference's square, at most kStrangest s^2: beyond that the tenth of
// pixels with any colour outweighs the Student-t (exactly at s = 1.2 grey levels, elsewhere
// nearly).
inline constexpr float kStrangest = 240;
double log_t_peak(double dof);

}  // namespace observation
}  // namespace walktrack
