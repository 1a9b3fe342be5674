// At which phases of the stride a detected walk may begin.
//
// Figures of the usual gait of its speed walk along its line, in step from the window's first frame
// to its last, and every term that needs one frame alone judges them, so that all frames together
// find the phase. With swapped legs it would be half a stride away: hypotheses
// (tracker/start/start_hypotheses.h) are tried near the best phase and half a stride from it, and
// their likelihood decides. tracker/reports/search.md has the measurements.
#pragma once

#include <deque>
#include <vector>

#include "tracker/start/start.h"
#include "tracker/subject_model.h"

namespace walktrack {
inline namespace tracker {

// The log-likelihood ratio of figures that begin in the middle of each range, nats, by range. A
// step may take a tenth less or more time than a usual one; the best of these counts.
std::vector<double> stride_scores(const TrackContext& context,
                                  const std::deque<SceneEvidence>& window, const DetectedWalk& walk,
                                  const std::vector<PhaseRange>& ranges);

// Those of phase_ranges() whose phase is the best one or next to it, or half a stride from these;
// all of them for a subject who stands at first, which has no phase, for one who is half hidden at
// first, on whom it was half a stride off, and for a walk that the scene states, perhaps without
// any evidence in single frames. Around a phase that the scene states nothing else is
// tried.
std::vector<PhaseRange> likely_ranges(const TrackContext& context,
                                      const std::deque<SceneEvidence>& window,
                                      const DetectedWalk& walk);

}  // namespace tracker
}  // namespace walktrack
