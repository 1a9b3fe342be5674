// How well a figure fits the person, by the evidence of its frame: the overlap of the figure with
// the foreground, and a comparison with the same figure at places beside it.
#pragma once

#include <vector>

#include "tracker/tracker_scene.h"

namespace walktrack {
inline namespace tracker {

struct FigureFit {
  std::vector<double> overlap;  // by camera (Overlap::share); NaN if it is unknown
  std::vector<double> seen;     // by camera: share of the figure's pixels that have evidence
  // How much better the best of the figures that stand 5 to 40 cm beside this one, or are turned by
  // 15 or 30 degrees, explains the outlines than this one: difference of the log-likelihoods, nats,
  // mean of the cameras. 0 if none of them is better.
  double better_beside = 0;
};

// Only the planes and the pixel weights of the evidence are used.
FigureFit figure_fit(const TrackerScene& scene, const SceneEvidence& evidence, const Pose& pose);

}  // namespace tracker
}  // namespace walktrack
