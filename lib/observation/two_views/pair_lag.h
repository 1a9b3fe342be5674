// Whether two cameras are in step, from the planes through both of them that touch the figure.
#pragma once

#include <optional>
#include <vector>

#include "camera/camera.h"
#include "observation/figures/moving_figure.h"

namespace walktrack {
inline namespace observation {

// How two cameras are out of step, found from the heights at which the figure's outline ends: a
// plane through both cameras that touches it in one image touches it in the other at that instant
// (epipolar tangents; Sinha & Pollefeys 2004). Frames are the scene's.
struct PairLag {
  int before = 0, after = 0;  // frames that the second camera shows things later than the first
  int changes_at = 0;         // frame from which `after` holds; equal lags: no change
  double sd = 0;              // frames, of `after` where nothing changes
  // The lag is about the time of one or more steps: a camera that stands a step further along the
  // walk than its calibration says would see the same. Also set if the time of a step is not known
  // and the lag is not shorter than a step may be.
  bool may_be_steps = false;
};
// nullopt if the cameras see too little to tell.
std::optional<PairLag> find_pair_lag(const std::vector<Camera>& cameras,
                                     const std::vector<FigurePath>& paths, double frame_rate);

}  // namespace observation
}  // namespace walktrack
