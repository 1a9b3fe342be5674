// Legs that change places: the left leg continues as the right one and the right one as the left,
// a common mistake of trackers without a model of walking.
#pragma once

#include <cstddef>

#include "body/motion.h"

namespace walktrack {
inline namespace metrics {

// How often, from one row to the next, knees and ankles are nearer to the predictions of the other
// leg than to their own (each joint continues as in the two rows before), by more than a hand's
// breadth in sum. Rows without the joints of both legs are skipped, and counting starts again after
// three successive known rows.
size_t leg_swaps(const Motion& motion);

}  // namespace metrics
}  // namespace walktrack
