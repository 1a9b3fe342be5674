// Measures motion in a video while nobody is tracked.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "observation/background/foreground_grid.h"
#include "tracker/tracker_scene.h"

namespace walktrack {
inline namespace jobs {

// The area that is newly covered by foreground, m^2 on the body, in the camera in which it is
// largest.
class MovementWatch {
 public:
  // `metres_per_px`: by camera, for a person in the middle of the scene. `dt`: s between frames.
  MovementWatch(std::vector<double> metres_per_px, double dt);

  // For a frame that was segmented as a whole, compared with the one kMovementTime before it; 0
  // until there is one.
  double newly_covered(const SceneEvidence& evidence);
  // To be called if a frame was not segmented as a whole.
  void forget() { before_.clear(); }

 private:
  std::vector<double> metres_per_px_;
  size_t frames_;
  std::deque<std::vector<ForegroundGrid>> before_;  // oldest first
};

}  // namespace jobs
}  // namespace walktrack
