// Legs that change places: the left leg goes on as the right one and the other way round, the
// classical mistake of trackers that see legs and not a walker.
#pragma once

#include <cstddef>

#include "body/motion.h"

namespace walktrack {
inline namespace metrics {

// How often, from one row to the next, knees and ankles lie nearer to where the other leg's were
// bound for than to where their own were (each joint going on as in the two rows before), by more
// than a hand's breadth in sum. Rows without the joints of both legs are passed over, and count
// nothing until three known ones have followed each other.
size_t leg_swaps(const Motion& motion);

}  // namespace metrics
}  // namespace walktrack
