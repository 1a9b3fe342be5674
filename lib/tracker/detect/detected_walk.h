// A straight walk over the ground that was found in a video or is stated by the scene. Metres,
// seconds.
#pragma once

#include <cmath>
#include <cstddef>

#include <Eigen/Core>

namespace walktrack {
inline namespace tracker {

// Where the person was and how they moved, on the ground, metres and m/s.
// Along the viewing ray both are less certain.
struct DetectedWalk {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // at the window's first frame
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  Eigen::Vector2d ray = Eigen::Vector2d::UnitX();  // over the ground, away from the first camera
  double position_sd = 0, velocity_sd = 0;         // along the ray
  bool given = false;                              // by the scene, not found in a video
  bool standing = false;  // stands still, and will set off at that velocity
  // Nats for each frame: how much better the walk explains it than an empty scene.
  double score = 0;
  // Share of the score that a figure standing in the middle of the walk does not reach.
  double over_standing = 0;
  size_t hidden_frames = 0;  // the first ones of the window, in which the person is half hidden
};

// The same walk so many seconds later.
inline DetectedWalk moved(const DetectedWalk& walk, double seconds) {
  DetectedWalk out = walk;
  out.position += seconds * walk.velocity;
  out.position_sd = std::hypot(walk.position_sd, seconds * walk.velocity_sd);
  return out;
}

}  // namespace tracker
}  // namespace walktrack
