// The trial of a detected walk: the frames of its window are tracked, beginning with it. The trial
// fails if the particles explain the frames worse than the rigid figures on a straight line with
// which the walk was detected.
//
// A start labels the legs by outlines, which from the side look the same with the legs swapped. If
// the images (tracker/start/leg_label_evidence.h) do not clearly agree, both labels are tried.
#pragma once

#include <deque>
#include <vector>

#include "tracker/modes/track_mode.h"

namespace walktrack {
inline namespace tracker {

struct Trial {
  TrackMode mode;                    // after the window's frames; Searching: the trial has failed
  std::vector<FrameRecord> records;  // of the frames that are finished, not refined
};

// `window`: the frames from number `first_frame` on. `walk_score`: score of the walk in all of
// them, nats.
Trial try_start(const TrackContext& context, const std::deque<SceneEvidence>& window,
                uint32_t first_frame, Starting start, double walk_score);

}  // namespace tracker
}  // namespace walktrack
