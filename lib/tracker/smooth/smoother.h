// Fixed-lag smoothing of the reported track: a frame in the light of those around it.
//
// Local quadratic regression (Cleveland, JASA 74, 1979), weighted by what each frame knows, too:
// every number of a frame becomes the value at its time of the parabola that fits it and the frames
// within the lag best,
//   minimise over a, b, c   sum_d w_d (x_d - a - b t_d - c t_d^2)^2,   w_d = k(t_d) / v_d,
// k normal with its third standard deviation at the lag, v_d the frame's own variance (particles
// and model, mean over the joints): frames in which the walker was hidden follow their neighbours.
// Parabolas pass through unchanged, so do joints and angles that belong to each other, to third
// order in the time. What the images could not tell in any of the frames stays as it is.
//
// Which foot stands, and since when, is left alone. tracker/reports/reported_pose.md says what else
// was tried, and what it gains.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

struct SmoothingConfig {
  double lag = 0.2;   // s of frames before and after a frame that count; 0 = off
  bool plant = true;  // feet stay where they stand, above the ground (tracker/smooth/planting.h)
};

// The weights, summing to one, of values at `times` (s from the wanted one, in (-lag, lag)) with
// `variances` > 0. Fewer than three values: a line, or the value itself.
std::vector<double> smoothing_weights(std::span<const double> times,
                                      std::span<const double> variances, double lag);

// Records in, smoothed ones out in the same order, as soon as the lag has passed. Frames that are
// not tracked come out as they are, and nothing is smoothed across them.
class Smoother {
 public:
  // `dt`: s between frames.
  Smoother(const SmoothingConfig& config, double dt);

  std::vector<FrameRecord> push(FrameRecord record);
  // Those that still wait at the end.
  std::vector<FrameRecord> finish();

 private:
  FrameRecord smoothed(size_t at) const;

  double lag_, dt_;
  size_t reach_;  // frames within the lag to one side
  std::deque<FrameRecord> window_;
  size_t waiting_ = 0;  // the newest of the window that have not come out
};

}  // namespace tracker
}  // namespace walktrack
