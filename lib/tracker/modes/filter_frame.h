// One frame of the particles of a track (tracker/walker_filter.h), in which left and right keep
// their names.
#pragma once

#include "tracker/subject_model.h"

namespace walktrack {
inline namespace tracker {

// Advances the particles by a frame. If left and right have switched, the legs are mirrored back.
// `filter_context`: that of the tracker, or with another motion. The record has the evidence by
// term.
FrameRecord filter_frame(const TrackContext& context, const WalkerFilterContext& filter_context,
                         const SceneEvidence& evidence, uint32_t frame, uint64_t seed,
                         WalkerFilter& filter);

}  // namespace tracker
}  // namespace walktrack
