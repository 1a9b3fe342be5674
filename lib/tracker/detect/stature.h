// Estimates the height of a person who walks along a line that was found with figures of a usual
// height.
//
// Cameras above a known ground determine the height: the feet show where the person stands, and the
// top of the head shows how tall the person is. For each of several heights the best line near the
// one that was found is searched (tracker/detect/detector.h). The peak of the log-posterior is the
// height, its curvature gives the standard deviation (Laplace's approximation: Tierney & Kadane,
// JASA 81, 1986). Hair, shoes, clothes and posture make figures of a wrong size fit better, so that
// the images of one video know less than that.
#pragma once

#include <functional>
#include <optional>

#include "tracker/detect/line_climb.h"
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

// The frames of a window, dt apart, in which a person is seen.
struct SizedWindow {
  size_t frames;
  double dt;                        // s
  Eigen::Vector2d camera_position;  // as in nearest_walk
  double metres_per_px;             // of the video that shows the person largest
  LinePrior known{};                // of the line, as in nearest_walk
};

// `walk`: the walk in the window, as it was found with figures of `height`. `known`: of the height
// before the images; nullopt: it is that of some adult, or of a child.
SizedWalk size_up(const DetectedWalk& walk, double height, const std::optional<Stature>& known,
                  const FigureScore& score, const SizedWindow& window);

// The same person with another height, all lengths in proportion; lengths that a scene states stay
// the same, and so does the mass.
BodyModel with_height(const BodyModel& model, double height);

}  // namespace tracker
}  // namespace walktrack
