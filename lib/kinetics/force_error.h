// How far estimated ground reactions are from true ones.
//
// What counts is the sum over both feet: how feet share it follows from rules, not from the motion
// (ground_contact.h). Truth has the frequencies of strikes, which no estimate from motion has, so
// the truth is smoothed as motions are (smoothing.h) before the two are compared; half a period of
// the cut-off at either end of it is left out.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace walktrack {
inline namespace kinetics {

struct GroundForces {
  std::vector<double> time;                          // s, increasing, evenly spaced
  std::vector<std::array<Eigen::Vector3d, 2>> feet;  // N, of the ground, by Side; NaN = unknown
};

struct ForceErrors {
  size_t count = 0;           // rows of the truth at which both are known
  double vertical_rms = 0;    // N, of the sum over both feet
  double horizontal_rms = 0;  // N, length of its horizontal error
};

// The estimate is taken at the truth's times, between neighbouring rows. `cutoff_hz` > 0.
ForceErrors force_errors(const GroundForces& truth, const GroundForces& estimate, double cutoff_hz);

}  // namespace kinetics
}  // namespace walktrack
