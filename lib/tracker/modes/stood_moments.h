// Moments of a track in which the subject stood: from them the frames after can be tracked again
// with another moment of setting off (tracker/start/set_off.h).
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <span>

#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

struct Tracking;

// A track after so many of its frames, without those that are held back or compete.
struct Moment {
  std::shared_ptr<const Tracking> track;
  size_t after;
};
Moment moment_of(const Tracking& now, size_t after);

// Moments are so many seconds apart, and so many of them are remembered. By hand.
inline constexpr double kMomentsApart = 0.15;
inline constexpr size_t kMoments = 6;

struct StoodMoments {
  std::deque<Moment> newest{};  // before the subject sets off
  size_t sets_off = 0;          // after so many frames they walk; 0 if they do not
};

// Looks at the newest of a track's frames, whose records are all given. Returns whether the subject
// sets off in it. `dt`: s between frames.
bool note_standing(double dt, const Tracking& now, std::span<const FrameRecord> records,
                   StoodMoments& stood);

// Forgets so many of the first frames.
void forget_first(size_t frames, StoodMoments& stood);

}  // namespace tracker
}  // namespace walktrack
