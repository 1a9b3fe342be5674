// Intervals in which a foot does not move.
#pragma once

#include <cstddef>

#include "body/pose.h"

namespace walktrack {
inline namespace body {

// Frames [first, last] in which the sole of that foot is flat on the ground.
struct FlatFoot {
  Side side;
  size_t first, last;
};

}  // namespace body
}  // namespace walktrack
