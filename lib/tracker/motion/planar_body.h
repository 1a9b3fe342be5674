// The subject as a kneed walker with the subject's own lengths (gait/walker_units.h has the walker
// of average lengths).
//
// Masses, centres of mass and radii of gyration: core/anthropometry.h, as shares of
// the subject's mass and of the segment's length; shank and foot are one part. The rolling foot has
// .3 leg lengths of radius, its arc's centre 5 cm (at a leg of .9275 m) ahead of the shank's axis
// and as high above the ankle as makes the ankle stand at its height (lib/walker, kneed_walker.h).
#pragma once

#include "body/subject.h"
#include "walker/kneed/kneed_walker.h"

namespace walktrack {
inline namespace tracker {

// `gravity` in m/s^2. Level ground; a slope is set by tilting the model's gravity.
KneedParameters kneed_parameters(const Subject& subject, double gravity);

}  // namespace tracker
}  // namespace walktrack
