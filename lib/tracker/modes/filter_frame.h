// One frame of the particles of a track (tracker/walker_filter.h), and whether left and right keep
// their names in it.
#pragma once

#include "tracker/subject_model.h"

namespace walktrack {
inline namespace tracker {

struct FilteredFrame {
  FrameRecord record;
  // With several cameras: whether the particles are in another half of the stride than expected.
  bool legs_switched = false;
};

// Advances the particles by a frame. If left and right have switched before one camera, which does
// not tell them apart, the legs are mirrored back. `filter_context`: that of the tracker, or with
// another motion. The record has the evidence by term.
FilteredFrame filter_frame(const TrackContext& context, const WalkerFilterContext& filter_context,
                           const SceneEvidence& evidence, uint32_t frame, uint64_t seed,
                           WalkerFilter& filter);

}  // namespace tracker
}  // namespace walktrack
