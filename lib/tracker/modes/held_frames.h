// The newest frames of a track, which are tracked and not reported yet. With several cameras they
// are held back until it is decided whether a new start among them, or another moment of setting
// off, explains them better (tracker/start/new_start.h).
#pragma once

#include <cstdint>
#include <vector>

#include "tracker/modes/filter_frame.h"
#include "tracker/modes/stood_moments.h"

namespace walktrack {
inline namespace tracker {

struct HeldFrames {
  uint32_t first;                      // number of the first one
  size_t until;                        // so many are held
  std::vector<FrameRecord> records{};  // of these frames so far
  bool legs_in_doubt = false;          // whether left and right may be swapped in some
  bool lost = false;                   // whether the track was lost in the last one
  StoodMoments stood{};                // of these frames

  bool enough() const { return lost || records.size() >= until; }
};

// Whether a track holds frames back.
bool holds_frames(const TrackContext& context);

// No frames yet, from number `frame` on.
HeldFrames held_from(const TrackContext& context, uint32_t frame);
// The frames of a start, which others will follow.
HeldFrames held_start(const TrackContext& context, uint32_t first_frame,
                      std::vector<FrameRecord> records, bool legs_in_doubt);

// Adds the next frame, with which the track has become `now`. If the legs have switched, or the
// subject sets off, more frames are held, which show what is right.
void hold(const TrackContext& context, FilteredFrame frame, const Tracking& now, HeldFrames& held);

// So many of the newest frames stay held back when the others are decided: of a subject who stands,
// because they may set off in the next one. Now and then none, so that a checkpoint can be written.
size_t frames_to_keep(const TrackContext& context, const HeldFrames& held);
// Those frames, and more that will follow.
HeldFrames kept_frames(const TrackContext& context, const HeldFrames& held, size_t count);

}  // namespace tracker
}  // namespace walktrack
