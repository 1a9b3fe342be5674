// Swapped legs: the left leg continues as the right one and the right one as the left, a common
// error of trackers without a model of walking.
#pragma once

#include <cstddef>

#include "body/motion.h"

namespace walktrack {
inline namespace metrics {

// The number of rows after which knees and ankles are nearer to the predictions of the other leg
// than to their own (each joint continues as in the two rows before), by more than 0.1 m in sum.
// Rows without the joints of both legs are skipped, and counting starts again after three
// successive known rows.
size_t leg_swaps(const Motion& motion);

}  // namespace metrics
}  // namespace walktrack
