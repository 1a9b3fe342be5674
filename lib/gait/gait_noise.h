// The noise around a gait of any walker: distributions of factors and deviations, and their
// densities.
#pragma once

#include "core/rng.h"
#include "gait/walker_units.h"

namespace walktrack {
inline namespace gait {

// Noise of the controls, drawn once for each step, and of the torques, drawn once for each time
// step.
struct GaitNoise {
  // Sd of stiffness, damping and impulse. With 0.02 step lengths and durations vary by the 2-3 % of
  // people; a filter needs at least twice as much, because the model differs from people (0.05: 5-6
  // % at 1.3 to 1.6 m/s).
  double relative = 0.05;
  double rest = 0.025;    // rad, sd of rest angles, scaled to a typical rest angle
  double torque = 0.002;  // sd of a joint's torque that is constant for 1/30 s, of M g L
};

// 1 + sd z, where z is normal and truncated at 3 (none of 1,000 particles leaves a gait's basin by
// a single draw, and 0.3 % of the mass is lost), never negative; and sd z.
double draw_factor(Rng& rng, double sd);
double draw_deviation(Rng& rng, double sd);

// Log-densities of value / mean and of a deviation; -infinity for values that are never drawn. For
// positive sd, of a factor up to 1/3.
double log_factor_density(double value, double mean, double sd);
double log_deviation_density(double deviation, double sd);

// Sd of a joint's torque that is constant for `duration` s, N m: it is proportional to 1 /
// sqrt(duration), so that a walker's diffusion does not depend on the frame rate. 0 without noise.
double torque_deviation(const GaitNoise& noise, const WalkerUnits& units, double duration);

}  // namespace gait
}  // namespace walktrack
