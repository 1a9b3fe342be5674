// Errors of estimated ground reactions.
//
// Only the sum over both feet is compared: its distribution between the feet follows from rules,
// not from the motion (ground_contact.h). The truth has the high frequencies of strikes, which no
// estimate from motion has, so that it is smoothed in the same way as motions (smoothing.h) before
// the comparison; half a period of the cut-off frequency is left out at either end.
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

// The estimate is interpolated at the truth's times. `cutoff_hz` > 0.
ForceErrors force_errors(const GroundForces& truth, const GroundForces& estimate, double cutoff_hz);

}  // namespace kinetics
}  // namespace walktrack
