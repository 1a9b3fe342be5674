// How tall is the person who walks along a line that was found with figures of a usual height?
//
// Cameras over known ground see it: the feet show where somebody stands, the top of the head how
// high that is. Figures taller and smaller, in steps, look for their own line near the one that was
// found (tracker/detect/detector.h). The peak of their log-posterior is the height, its curvature
// the spread (Laplace's approximation: Tierney & Kadane, JASA 81, 1986).
#pragma once

#include <functional>

#include "tracker/detect/detector.h"
#include "tracker/state/particle.h"

namespace walktrack {
inline namespace tracker {

struct Stature {
  double height, sd;  // m
};

// The score of a figure of that height, m.
using FigureScore = std::function<WindowScore(double height)>;

struct SizedWalk {
  Stature stature;
  DetectedWalk walk;  // its line for that height
};

// `walk`: of a window's frames, dt apart, as figures of `height` see it. `camera_position` as in
// detect_walk.
SizedWalk size_up(const DetectedWalk& walk, double height, size_t frames, const FigureScore& score,
                  double dt, const Eigen::Vector2d& camera_position);

// The same person, all in proportion; lengths that a scene states stay, and so does the mass.
BodyModel with_height(const BodyModel& model, double height);

}  // namespace tracker
}  // namespace walktrack
