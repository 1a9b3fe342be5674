// The colours of a subject who has just been found before one camera.
//
// Until then everything that differs from the empty scene is evidence. Clothes in the colours of
// the scene, or of its shadows, are not: trousers like a wooden floor make a figure whose legs end
// above them more probable than the subject's own, metres nearer or farther. The colours of all
// that the figures of the walk cover in a window of frames tell what the subject wears; compared
// with them, the same frames show where the subject is. One such step of expectation maximisation
// suffices (tracker/reports/one_camera.md).
#pragma once

#include <deque>
#include <optional>

#include "observation/background/appearance.h"
#include "tracker/detect/detected_walk.h"
#include "tracker/subject_model.h"

namespace walktrack {
inline namespace tracker {

// Of the figures that walk along there, by the window's frames; nullopt if the frames do not keep
// their colours, or contain nothing to learn from.
std::optional<AppearanceModel> clothes_of(const TrackContext& context,
                                          const std::deque<SceneEvidence>& window,
                                          const DetectedWalk& walk);

// Compares the pixels of a frame with the clothes of somebody at that place, from whose
// surroundings alone evidence is kept, so that it takes little memory.
void compare_with(const AppearanceModel& clothes, const TrackContext& context,
                  const Eigen::Vector2d& place, SceneEvidence& frame);

// Undoes that.
void forget_clothes(const TrackContext& context, SceneEvidence& frame);

// Drops the colours, with which the evidence could still change.
void drop_colours(SceneEvidence& frame);

}  // namespace tracker
}  // namespace walktrack
