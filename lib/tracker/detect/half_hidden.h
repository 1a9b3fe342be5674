// A subject who comes out from behind something at the beginning of a walk. Without knowing what is
// in front of the subject, a figure is pushed out of the pixels that show it, its place is wrong,
// and so is the phase of its stride (observation/silhouette/hidden_pixels.h).
#pragma once

#include <deque>

#include "tracker/detect/detected_walk.h"
#include "tracker/subject_model.h"

namespace walktrack {
inline namespace tracker {

// Removes the pixels of the things that hide the subject in the first frames, in `least` of them or
// more, from the evidence of all frames. A camera from which the subject is whole keeps its
// evidence. `walk`: its place is that in the first frame.
void hide_occluders(const TrackContext& context, const DetectedWalk& walk, size_t least,
                    std::deque<SceneEvidence>& frames);

}  // namespace tracker
}  // namespace walktrack
