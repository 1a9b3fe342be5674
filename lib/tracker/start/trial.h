// A walk that was detected is put to the test: its window's frames are tracked from it. It fails if
// the particles explain them worse than the straight walk of mere figures that it came from.
//
// A start names the legs by outlines, which from the side look the same with the legs swapped.
// Where the pictures (tracker/start/leg_label_evidence.h) do not quite agree, both names are tried.
#pragma once

#include <deque>
#include <vector>

#include "tracker/modes/track_mode.h"

namespace walktrack {
inline namespace tracker {

struct Trial {
  TrackMode mode;                    // after the window's frames; Searching: the walk has failed
  std::vector<FrameRecord> records;  // finished ones, not refined
};

// `window`: the frames from number `first_frame` on. `walk_score`: nats of the walk in all of them.
Trial try_start(const TrackContext& context, const std::deque<SceneEvidence>& window,
                uint32_t first_frame, Starting start, double walk_score);

}  // namespace tracker
}  // namespace walktrack
