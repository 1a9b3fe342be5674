// How long sampled walkers keep walking, which measures the basin of a gait under noise.
#pragma once

#include <vector>

#include "gait/prior/gait_prior.h"
#include "gait/prior/straight_prior.h"

namespace walktrack {
inline namespace gait {

struct SurvivalTrial {
  double speed = 1.3;      // m/s
  double step_length = 0;  // m; 0: the one that people prefer at the speed
  GaitNoise noise;
  double feedback = 1;            // strength, 0: none
  double torque_step = 1.0 / 30;  // s for which a torque is constant
  size_t walkers = 1000;
  uint64_t seed = 1;
};

// Share of walkers that still walk after each of the times (s, ascending), from uniformly
// distributed phases.
std::vector<double> survival(const GaitPrior& prior, const KneedParameters& parameters,
                             const SurvivalTrial& trial, const std::vector<double>& times,
                             int threads);
std::vector<double> survival(const StraightPrior& prior, const StraightLeggedParameters& parameters,
                             const SurvivalTrial& trial, const std::vector<double>& times,
                             int threads);

}  // namespace gait
}  // namespace walktrack
