// Decides whether a track is lost in a frame: computes what the monitor (tracker/modes/monitor.h)
// needs of the frame's images, and returns its decision.
#pragma once

#include "tracker/subject_model.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

// Updates the monitor with the frame, unless no particle has survived it. A track is also lost to a
// rigid figure with the usual gait that explains the images better in the same place, or, before
// one camera, at another distance; the subject was then last seen where that figure is.
bool is_lost(const TrackContext& context, const SceneEvidence& evidence, uint32_t frame,
             const FrameRecord& record, MonitorState& monitor);

}  // namespace tracker
}  // namespace walktrack
