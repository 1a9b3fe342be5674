// The direction in which somebody walks, on the ground.
//
// The body sways from foot to foot with every step, by several centimetres when it walks slowly:
// from one strike, or one stance, to the next the pelvis moves up to 20 degrees off the way that
// the person takes. After a whole stride it is on the same side again, so that the direction is
// that of the pelvis's displacement in one stride around the wanted time. Near the ends of the
// motion, and beside gaps, that stride is moved inside. Metres, seconds.
#pragma once

#include <Eigen/Core>

#include "body/motion.h"

namespace walktrack {
inline namespace metrics {

// A unit vector; NaN if the pelvis is unknown at that time or has not moved.
Eigen::Vector2d walking_direction(const Motion& motion, double time, double stride_time);

// A joint from above at any time, linearly between rows; NaN outside of them.
Eigen::Vector2d on_ground(const Motion& motion, Joint joint, double time);

}  // namespace metrics
}  // namespace walktrack
