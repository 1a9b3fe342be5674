// Where a foot stands still.
#pragma once

#include <cstddef>

#include "body/pose.h"

namespace walktrack {
inline namespace body {

// Frames [first, last] in which the sole of that foot lies flat.
struct FlatFoot {
  Side side;
  size_t first, last;
};

}  // namespace body
}  // namespace walktrack
