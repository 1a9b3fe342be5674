// The frames of a window, tracked from a start on: what a trial (tracker/start/trial.h) compares.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "tracker/modes/track_mode.h"

namespace walktrack {
inline namespace tracker {

// A moved deque allocates an empty one.
struct Attempt {  // NOLINT(bugprone-exception-escape)
  TrackMode mode;
  std::vector<FrameRecord> records{};
  std::optional<Moment> settled{};  // when the start was decided
  bool legs_in_doubt = false;       // before several cameras
  double legs = 0;                  // log-odds that the legs have the right labels
  StoodMoments stood{};             // at first, before several cameras
};

struct WindowFrames {
  const TrackContext& context;
  const std::deque<SceneEvidence>& frames;
  uint32_t first;
};

// Of frames together, by the particles, nats; an attempt's include those of its start so far.
double total_log_likelihood(std::span<const FrameRecord> records);
double total_log_likelihood(const Attempt& attempt);

// Continues after the attempt's records, until so many frames have been tracked.
void follow_rest(const WindowFrames& window, Attempt& attempt,
                 size_t until = std::numeric_limits<size_t>::max());

}  // namespace tracker
}  // namespace walktrack
