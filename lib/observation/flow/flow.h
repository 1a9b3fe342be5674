// Optical flow without measuring it: the probability of a frame given the frame before, if a body
// has moved from one pose to the other.
//
// With the grey images I (now) and J (before), and S the visible silhouette, every pixel u of the
// frame is one of three kinds:
//   of the body, u in S_now: the same material point was at w a frame ago. I(u) is Student-t about
//     J(w), or anything at all, 1 / 256, where another part hid the point or w is off the picture;
//   uncovered, u in S_before and not in S_now: background that J does not show; I(u) is as the
//     background's model says, or anything at all without one;
//   background at rest: I(u) is Student-t about J(u).
// For any two poses this is a normalised density of all pixels that are used, and the term is
//   sum over S_now [log p_body - log p_rest] + sum over S_before \ S_now [log p_uncovered - log
//   p_rest],
// which is zero for a body at rest. The squared scale of the Student-t is noise^2 + (error_px^2 +
// error_share^2 |u - w|^2) |grad J|^2, of a body at rest as of background. J is as bright as I: the
// light's gain between the frames has been taken out.
//
// Moving things that are no part of the body (arms that it does not have, shadows, people behind)
// must not pull the body towards them: a tenth of the pixels, at rest or of the body, may have any
// colour, which bounds the effect of a single pixel.
//
// The pixels that are used form a lattice with a spacing of a few centimetres on the body, after
// smoothing that matches this spacing, and each counts for its area. Measured flow would be wrong
// at exactly the places that matter (reports/flow.md), and it is not needed, because each particle
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
  float now;        // grey level; below zero: an occluder stands here, nothing is known
  float at_rest;    // log p_rest
  float uncovered;  // log p_uncovered - log p_rest
};

// A pixel of the frame before, as bright as it would be now.
struct EarlierPixel {
  float grey;
  float slope2;  // |grad J|^2, squared grey levels per px^2; below zero: an occluder stands here
};

// Two successive frames around a walker.
struct FlowField {
  PixelRect area;  // pixels of the density
  int step = 1;  // px between the pixels that are used: (area.x0 + column step, area.y0 + row step)
  int columns = 0, rows = 0;
  std::vector<FlowCell> cells;  // row by row; none when there is no frame before
  LogRatioPlanes uncovered;     // prefix sums of FlowCell::uncovered, x and y being column and row
  PixelRect known;              // of the frame before
  std::vector<EarlierPixel> before;  // row by row
};

// Most cells of a field: a figure's silhouette in them fits on the stack.
inline constexpr size_t kMaxFlowCells = 16'384;

// The empty scene, where there is a model of it.
struct FlowBackground {
  const BackgroundModel* model = nullptr;
  double gain = 1;  // strength of the light now relative to the model
};

// `before` and `now`: of one size, a pixel of the walker showing `metres_per_px`. Reuses the memory
// of `out`; an empty area gives no cells.
void make_flow_field(const ObservationConfig& config, const GreyImage& before, const GreyImage& now,
                     const FlowBackground& background, const PixelRect& area, double metres_per_px,
                     FlowField& out);

// Nothing is known where `blocked` (of a frame's size) is not zero. Needs finish_flow_field().
void block(const cv::Mat& blocked, FlowField& field);
// Sums up what is uncovered: the last step.
void finish_flow_field(FlowField& field);

// How much brighter `now` is than `before`: the median over points of the picture.
double light_gain(const GreyImage& before, const GreyImage& now);

// Nats times square pixels: each cell weighs as much as the area it stands for. `now` and `before`
// are the capsules of one particle in this and the previous frame.
double flow_log_ratio(const FlowConfig& config, const FlowField& flow, const CapsuleList& now,
                      const CapsuleList& before);

// log of the density of a difference: log_t_peak + dof / 2 log s^2 - (dof + 1) / 2 log(dof s^2 +
// d^2) with d^2 the difference's square, at most kStrangest s^2: beyond that the tenth of pixels
// that may be anything outweighs the Student-t (at s = 1.2 grey levels; elsewhere nearly).
inline constexpr float kStrangest = 240;
double log_t_peak(double dof);

}  // namespace observation
}  // namespace walktrack
