// Estimates the height of a person who walks along a line that was found with figures of a usual
// height.
//
// Cameras above a known ground determine the height: the feet show where the person stands, and the
// top of the head shows how tall the person is. For each of several heights the best line near the
// one that was found is searched (tracker/detect/detector.h). The peak of the log-posterior is the
// height, its curvature gives the standard deviation (Laplace's approximation: Tierney & Kadane,
// JASA 81, 1986).
#pragma once

#include <functional>

#include "tracker/detect/detector.h"
#include "tracker/state/particle.h"

namespace walktrack {
inline namespace tracker {

struct Stature {
  double height, sd;  // m
};

// What is known of a height that nobody states: adults of both sexes, with a spread that is wide
// enough for others if the images show them. By hand.
inline constexpr Stature kUsualStature{1.70, 0.15};

// The score of a figure of that height, m.
using FigureScore = std::function<WindowScore(double height)>;

struct SizedWalk {
  Stature stature;
  DetectedWalk walk;  // its line for that height
};

// `walk`: the walk in a window's frames, dt apart, as it was found with figures of `height`.
// `known`: of the height before the images. `camera_position` as in nearest_walk.
SizedWalk size_up(const DetectedWalk& walk, double height, const Stature& known, size_t frames,
                  const FigureScore& score, double dt, const Eigen::Vector2d& camera_position);

// The same person with another height, all lengths in proportion; lengths that a scene states stay
// the same, and so does the mass.
BodyModel with_height(const BodyModel& model, double height);

}  // namespace tracker
}  // namespace walktrack
