// The subject as a kneed walker with the subject's own lengths (gait/walker_units.h has the walker
// of average lengths).
//
// Masses, centres of mass and radii of gyration: core/anthropometry.h, as shares of the subject's
// mass and of the segment's length; shank and foot are one part. The rolling foot has a radius of
// .3 leg lengths. The centre of its arc is 5 cm (for a leg of .9275 m) in front of the shank's
// axis, and above the ankle so far that the ankle is at its height when standing (lib/walker,
// kneed_walker.h).
#pragma once

#include "body/subject.h"
#include "walker/kneed/kneed_walker.h"

namespace walktrack {
inline namespace tracker {

// `gravity` in m/s^2. Level ground; a slope is set by tilting the model's gravity.
KneedParameters kneed_parameters(const Subject& subject, double gravity);

}  // namespace tracker
}  // namespace walktrack
