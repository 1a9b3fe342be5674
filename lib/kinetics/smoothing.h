// Smoothing of joint centres before they are differentiated twice.
//
// A second-order Butterworth low-pass, run forwards and backwards: no lag, fourth order in effect,
// with the cut-off corrected for the two passes (Winter, "Biomechanics and Motor Control of Human
// Movement", 4th ed. 2009, section 3.4.4). Before its first and after its last row an interval is
// continued by its reflection in its end point; within half a period of the cut-off from an end the
// result depends on that assumption.
#pragma once

#include <span>
#include <vector>

#include "body/motion.h"

namespace walktrack {
inline namespace kinetics {

// Smoothed values at `rate` per second; unchanged if `cutoff_hz` is 0 or not below half of the
// rate, or if there are fewer than 4.
std::vector<double> low_pass(std::span<const double> values, double rate, double cutoff_hz);

// Consecutive rows of a motion.
struct Span {
  size_t begin, end;
};

// Smooths every joint that is known throughout the interval; the others become unknown.
std::vector<JointPositions> smoothed(const Motion& motion, const Span& span, double rate,
                                     double cutoff_hz);

}  // namespace kinetics
}  // namespace walktrack
