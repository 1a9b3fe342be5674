// The trial of a detected walk: the frames of its window are tracked, beginning with it. The trial
// fails if the particles explain the frames clearly worse than the rigid figures on a straight line
// with which the walk was detected; that of a walk which the scene states, if they explain them
// worse than an empty scene.
//
// A start labels the legs by outlines, which from the side look the same with the legs swapped. If
// the images (tracker/start/leg_label_evidence.h) do not clearly agree, both labels are tried.
#pragma once

#include <deque>
#include <vector>

#include "tracker/modes/track_mode.h"

namespace walktrack {
inline namespace tracker {

// A moved deque allocates an empty one.
struct Trial {                         // NOLINT(bugprone-exception-escape)
  TrackMode mode;                      // after the window's frames; Searching: the trial has failed
  std::vector<FrameRecord> records{};  // of the frames that are finished, not refined
  double log_likelihood = 0;           // of the window's frames together, nats, by the particles
  bool legs_in_doubt = false;          // before several cameras
};

// `window`: the frames from number `first_frame` on. `number` counts the starts from 1. `before`:
// the mode from which the walk is tried.
Trial try_start(const TrackContext& context, const std::deque<SceneEvidence>& window,
                uint32_t first_frame, const DetectedWalk& walk, uint32_t number,
                const Searching& before);

}  // namespace tracker
}  // namespace walktrack
