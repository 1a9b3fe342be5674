// Complementarity of the two knee stops, at the level of rates (impulse) and of accelerations
// (reactive torque): with the positive definite 2 x 2 matrix W = a' M^-1 a find
//   push >= 0,  gain = free + W push >= 0,  push . gain = 0
// over the knees at their stops. The solution is unique, so that it is found by trying every set of
// pushing stops, smallest sets first.
#pragma once

#include <array>

#include "walker/kneed/kneed_walker.h"

namespace walktrack {
inline namespace walker {

// Makes a state consistent with its knee stops: negative flexion is set to zero, rates into a stop
// are removed by the plastic impulse, and a stop is active only if it pushes. Returns the stops'
// impulses (stance, swing), N m s, >= 0.
std::array<double, 2> settle_knee_stops(const KneedModel& model, const KneedControls& controls,
                                        const Vector5& noise, KneedState& state);

// The sub-step of explicit RK4 at this state: small relative to the fastest spring and damper.
double kneed_step_size(const KneedModel& model, const KneedControls& controls,
                       const KneedState& state, double max_step);

}  // namespace walker
}  // namespace walktrack
