// Whether a track is lost in a frame: what the monitor (tracker/modes/monitor.h) has to be told of
// the frame's images, and what it then says.
#pragma once

#include "tracker/subject_model.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

// The monitor takes in all that there is to say of the frame, unless no particle has survived it.
bool is_lost(const TrackContext& context, const SceneEvidence& evidence, const FrameRecord& record,
             MonitorState& monitor);

}  // namespace tracker
}  // namespace walktrack
