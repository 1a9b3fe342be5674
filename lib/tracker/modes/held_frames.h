// The newest frames of a track, which are tracked and not reported yet. With several cameras they
// are held back until it is decided whether a new start among them explains them better
// (tracker/start/new_start.h).
#pragma once

#include <cstdint>
#include <vector>

#include "tracker/modes/filter_frame.h"

namespace walktrack {
inline namespace tracker {

struct HeldFrames {
  uint32_t first;                      // number of the first one
  size_t until;                        // so many are held
  std::vector<FrameRecord> records{};  // of these frames so far
  bool legs_in_doubt = false;          // whether left and right may be swapped in some
  bool lost = false;                   // whether the track was lost in the last one

  bool enough() const { return lost || records.size() >= until; }
};

// Whether a track holds frames back.
bool holds_frames(const TrackContext& context);

// No frames yet, from number `frame` on.
HeldFrames held_from(const TrackContext& context, uint32_t frame);
// The frames of a start, which others will follow.
HeldFrames held_start(const TrackContext& context, uint32_t first_frame,
                      std::vector<FrameRecord> records, bool legs_in_doubt);

// Adds the next frame. If the legs have switched, more frames are held, which show who is right.
void hold(const TrackContext& context, FilteredFrame frame, HeldFrames& held);

}  // namespace tracker
}  // namespace walktrack
