// Tests whether two cameras are synchronous, by the planes through both of them that touch the
// figure.
#pragma once

#include <optional>
#include <vector>

#include "camera/camera.h"
#include "observation/figures/moving_figure.h"

namespace walktrack {
inline namespace observation {

// The lag between two cameras, found from the heights of the ends of the figure's outline: a plane
// through both cameras that touches it in one image touches it in the other at the same time
// (epipolar tangents; Sinha & Pollefeys 2004). Frames are the scene's.
struct PairLag {
  int before = 0, after = 0;  // frames by which the second camera lags behind the first
  int changes_at = 0;         // frame from which `after` holds; equal lags: no change
  double sd = 0;              // frames, of `after` if there is no change
  double agreement = 0;       // of the outlines' ends with a change, 0 to 1
  // The lag is about the time of one or more steps: a camera at a wrong position, a step further
  // along the walk, would give the same. Also set if the time of a step is unknown and the lag is
  // not shorter than a step can be.
  bool may_be_steps = false;
};
// nullopt if the cameras see too little.
std::optional<PairLag> find_pair_lag(const std::vector<Camera>& cameras,
                                     const std::vector<FigurePath>& paths, double frame_rate);

}  // namespace observation
}  // namespace walktrack
