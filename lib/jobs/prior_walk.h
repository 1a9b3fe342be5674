// A walk out of the table of gaits: at every support transfer the kneed walker takes the controls
// of the gait at the speed wanted by then, corrected by the feedback: `walktrack simulate --prior`.
#pragma once

#include <vector>

#include "jobs/simulate.h"

namespace walktrack {

struct SpeedChange {
  double time = 0;   // s, when the change begins
  double speed = 0;  // m/s, of the body
};

struct PriorWalk {
  double speed = 1.3;                // m/s, of the body
  std::vector<SpeedChange> changes;  // times ascend
  double step_length = 0;            // m; 0: what people prefer at the speed
  double feedback = 1;               // strength, 0 switches it off
  // Neighbouring gaits lie in each other's basins. At 0.3 m/s^2 walkers fall that slow down from
  // 1.7 to 1.0 m/s, at 0.2 they do not.
  double acceleration = 0.2;  // m/s^2
};

// The speed wanted at a time: ramps of `acceleration` from each change on.
double wanted_speed(const PriorWalk& walk, double time);

// The job with start, controls and later steps out of the shipped table, for the parameters of
// `job.model`. UsageError where the model is not the kneed walker with a torso.
SimulateJob with_prior(SimulateJob job, const PriorWalk& walk);

}  // namespace walktrack
