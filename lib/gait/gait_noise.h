// The noise around a gait, of whatever walker: what a factor or a deviation is drawn from, and with
// which density.
#pragma once

#include "core/rng.h"
#include "gait/walker_units.h"

namespace walktrack {
inline namespace gait {

// Noise of the controls, drawn once a step, and of the torques, drawn once a time step.
struct GaitNoise {
  // Sd of stiffness, damping and impulse. 0.02 makes step lengths and durations vary by the 2-3 %
  // of people; a filter needs twice that as more, because the model differs from people (0.05: 5-6
  // % at 1.3 to 1.6 m/s)
  double relative = 0.05;
  double rest = 0.025;    // rad, sd of rest angles: the same in units of a typical rest angle
  double torque = 0.002;  // sd of a joint's torque held over 1/30 s, of M g L
};

// 1 + sd z, z normal and cut at 3 (none of 1,000 particles leaves a gait's basin by a single draw,
// and 0.3 % of the mass is lost), never below zero; and sd z.
double draw_factor(Rng& rng, double sd);
double draw_deviation(Rng& rng, double sd);

// Logarithms of the densities with which value / mean and a deviation are drawn; -infinity for what
// is never drawn. For sd above zero, of a factor up to 1/3.
double log_factor_density(double value, double mean, double sd);
double log_deviation_density(double deviation, double sd);

// Sd of a joint's torque held for `duration` s, N m: falls with sqrt(duration), so that a walker's
// diffusion does not depend on the frame rate. 0 where there is none.
double torque_deviation(const GaitNoise& noise, const WalkerUnits& units, double duration);

}  // namespace gait
}  // namespace walktrack
