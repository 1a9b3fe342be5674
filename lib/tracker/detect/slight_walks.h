// Walks that explain a window of frames hardly better than somebody who stands in their middle.
// Along the viewing ray a person who stands sometimes seems to walk, and one who walks is explained
// by standing nearly as well. But the walks that are found in window after window only move on if
// the person does.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include <Eigen/Core>

#include "tracker/detect/detected_walk.h"

namespace walktrack {
inline namespace tracker {

struct SlightWalk {
  uint32_t first_frame;    // of its window
  Eigen::Vector2d middle;  // m, where it is in the middle of the window
};

struct SlightWalks {
  std::deque<SlightWalk> newest{};          // by frame, those that began within a window's length
  std::optional<uint32_t> moved_on_from{};  // first frame of the first of those that moved on
};

// Adds the walk of a window that begins with frame number `first_frame` and lasts `seconds`; frames
// are `dt` s apart. Returns whether the person walks, by this window and those before it.
bool walks_on(uint32_t first_frame, const DetectedWalk& walk, double seconds, double dt,
              SlightWalks& walks);

}  // namespace tracker
}  // namespace walktrack
