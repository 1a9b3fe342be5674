// How well a figure lies on the person, by the evidence of its frame: as far as it and the
// foreground cover each other, and against figures that are free to stand beside it.
#pragma once

#include <vector>

#include "tracker/tracker_scene.h"

namespace walktrack {
inline namespace tracker {

struct FigureFit {
  std::vector<double> overlap;  // by camera (Overlap::share); NaN where nothing is known
  // By how much the images speak more for the best of the figures that stand 5 to 40 cm beside this
  // one, or turn away from it by 15 or 30 degrees, than for this one: a share of what they say for
  // that. 0 if they speak for none of them more, or for none at all.
  double better_beside = 0;
};

// Of the evidence, only planes and pixel weights are read.
FigureFit figure_fit(const TrackerScene& scene, const SceneEvidence& evidence, const Pose& pose);

}  // namespace tracker
}  // namespace walktrack
