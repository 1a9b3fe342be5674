// Whether somebody moves in a video while nobody is tracked.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "observation/background/foreground_grid.h"
#include "tracker/tracker_scene.h"

namespace walktrack {
inline namespace jobs {

// How much of the pictures somebody newly covers, m^2 on the body, in the camera that sees most of
// it.
class MovementWatch {
 public:
  // `metres_per_px`: by camera, of somebody somewhere in the middle of it. `dt`: s between frames.
  MovementWatch(std::vector<double> metres_per_px, double dt);

  // Of a frame that was looked at as a whole, against kMovementTime before it; 0 until there is
  // one.
  double newly_covered(const SceneEvidence& evidence);
  // Frames were not looked at as a whole.
  void forget() { before_.clear(); }

 private:
  std::vector<double> metres_per_px_;
  size_t frames_;
  std::deque<std::vector<ForegroundGrid>> before_;  // oldest first
};

}  // namespace jobs
}  // namespace walktrack
