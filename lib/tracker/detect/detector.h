// Finds a walking person before any tracking: the straight line over the ground along which a
// walking figure of the subject's size explains the foreground of a short stretch of video best.
//
// One frame of one camera hardly determines how far away a person is. A stretch of walking does,
// because one speed and one size must fit every frame. Candidate places in two frames propose
// lines, which are scored on all frames and refined.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "tracker/detect/detector_config.h"
#include "tracker/detect/figure_places.h"
#include "tracker/detect/line_climb.h"

namespace walktrack {
inline namespace tracker {

// The two frames of a window for which candidate places are needed: every line that is tried goes
// through a candidate of each.
struct WindowEnds {
  size_t early, late;
};
WindowEnds window_ends(size_t frames);

struct WindowCandidates {
  size_t frames;  // of the window
  std::span<const Place> early, late;
  std::span<const DetectedWalk> lines{};  // further lines to try, which do not come from candidates
  LineCondition may_be{};                 // empty: any line may
};

// The walk through a window's frames, which are dt apart; nullopt if nobody walks there, or if the
// person is cut off by an edge or hidden in some of the frames. `camera_positions`: the places of
// the cameras, at least one. The distance is least certain along the rays of the first (any camera,
// if there are several).
std::optional<DetectedWalk> detect_walk(const WindowCandidates& candidates,
                                        const WindowScore& score, double dt,
                                        std::span<const Eigen::Vector2d> camera_positions,
                                        const DetectorConfig& config, int threads);

}  // namespace tracker
}  // namespace walktrack
