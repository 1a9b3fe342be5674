// Whether the legs of a track have the right labels, from the motion of the images while the legs
// pass each other (observation/flow/leg_order.h). It is used for one camera; from two sides
// silhouettes suffice.
#pragma once

#include <deque>
#include <span>

#include "tracker/tracker_scene.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

// Log-odds, nats, by the images of successive frames, that a track's legs have the right labels
// instead of being swapped; 0 if the images contain no evidence. There is one record for each of
// the first frames of `window`.
double legs_log_odds(const TrackerScene& scene, const std::deque<SceneEvidence>& window,
                     std::span<const FrameRecord> records);

// The same by a frame's keypoints, for the legs of a pose, tempered nats; 0 without keypoints.
double names_in_frame(const TrackerScene& scene, const SceneEvidence& evidence, const Pose& pose);

}  // namespace tracker
}  // namespace walktrack
