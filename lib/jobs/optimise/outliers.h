// Joints of a motion that are far off in a few frames, as where a detector took something else for
// the joint: by Hampel's rule with a fixed limit (Davies & Gather, J. Am. Stat. Assoc. 88 (1993),
// 782-792), a joint that is further than kFarOff from the median of its neighbours is taken to be
// there.
#pragma once

#include "body/motion.h"

namespace walktrack {
inline namespace jobs {

// The median over this time before and after a row. A joint that is off for longer stays. By hand.
inline constexpr double kNeighbours = 0.15;  // s
// By hand: in the 24 walks of motion capture at hand no joint is further than 8 cm from that
// median.
inline constexpr double kFarOff = 0.15;  // m

// Moves such joints there, axis by axis; returns their number. Joints with fewer than four known
// neighbours stay, also those of the first two and the last two rows.
size_t replace_outliers(Motion& motion);

}  // namespace jobs
}  // namespace walktrack
