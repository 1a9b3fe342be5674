// Whether the legs of a track bear the right names, asked of how the images move where the legs
// pass each other (observation/flow/leg_order.h). For one camera: from two sides silhouettes tell
// by themselves.
#pragma once

#include <deque>
#include <span>

#include "tracker/tracker_scene.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

// How much more the pictures of successive frames speak for a track's legs than for the same legs
// swapped, nats; 0 where nothing is to be seen of it. One record for each of the first frames of
// `window`.
double legs_log_odds(const TrackerScene& scene, const std::deque<SceneEvidence>& window,
                     std::span<const FrameRecord> records);

// How much more a frame's keypoints speak for a pose's legs than for the same legs swapped, nats
// of evidence that counts once; 0 without any.
double names_in_frame(const TrackerScene& scene, const SceneEvidence& evidence, const Pose& pose);

}  // namespace tracker
}  // namespace walktrack
