// A new start beside a track. Before several cameras the images show which leg is which. Particles
// that suddenly take the left leg for the right one have therefore lost the place in the stride,
// now or some time ago, and they take a stride to find it again. Or nothing switches, but the
// overlap of figure and person falls (tracker/overlaps.h), or the track is lost. So the newest
// frames of a track are held back (HeldFrames). In these cases they are tracked once more from a
// start of their own (tracker/start/trial.h), and the track with the larger likelihood is kept. If
// the subject has set off, they are tracked again from other moments (tracker/start/set_off.h).
// tracker/reports/left_and_right.md has measurements.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "tracker/modes/track_mode.h"

namespace walktrack {
inline namespace tracker {

// Whether frames are held back, and whether they are enough to be decided.
bool holding(const TrackMode& mode);
bool held_enough(const TrackMode& mode);

// Decides the frames that are held back, and returns the judged records of those that are not held
// back further; `mode` continues with the better track. `frames`: their evidence. `starts`: the
// number of starts so far.
std::vector<FrameRecord> decide_held(const TrackContext& context,
                                     const std::deque<SceneEvidence>& frames, bool more_follow,
                                     uint32_t& starts, TrackMode& mode);

}  // namespace tracker
}  // namespace walktrack
