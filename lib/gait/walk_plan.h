// A walk out of the table of gaits: how fast it is to be when, and which gait that asks for.
#pragma once

#include <vector>

#include "gait/gait_prior.h"

namespace walktrack {

struct SpeedChange {
  double time = 0;   // s, when the change begins
  double speed = 0;  // m/s, of the body
};

struct WalkPlan {
  double speed = 1.3;                // m/s, of the body
  std::vector<SpeedChange> changes;  // times ascend
  double step_length = 0;            // m; 0: what people prefer at the speed
  double feedback = 1;               // strength, 0 switches it off
  // Neighbouring gaits lie in each other's basins. At 0.3 m/s^2 walkers fall that slow down from
  // 1.7 to 1.0 m/s, at 0.2 they do not.
  double acceleration = 0.2;  // m/s^2
};

// The speed wanted at a time: ramps of `acceleration` from each change on.
double wanted_speed(const WalkPlan& plan, double time);

// The gait of the table for the speed wanted at a time.
PriorGait planned_gait(const GaitPrior& prior, const KneedParameters& parameters,
                       const WalkPlan& plan, double time);

}  // namespace walktrack
