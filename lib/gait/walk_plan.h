// A plan of speeds for a walk, and the gaits of the table that it needs.
#pragma once

#include <vector>

#include "gait/prior/gait_prior.h"
#include "gait/prior/straight_prior.h"

namespace walktrack {
inline namespace gait {

struct SpeedChange {
  double time = 0;   // s, beginning of the change
  double speed = 0;  // m/s, of the body
};

struct WalkPlan {
  double speed = 1.3;                // m/s, of the body
  std::vector<SpeedChange> changes;  // times ascend
  double step_length = 0;            // m; 0: the one that people prefer at the speed
  double feedback = 1;               // strength, 0: none
  double acceleration = 0.2;         // m/s^2, largest one: see next_gait()
};

// The planned speed at a time.
double planned_speed(const WalkPlan& plan, double time);

// Lowest and highest speed of a table for a body, m/s.
struct SpeedRange {
  double least, most;
};
SpeedRange speed_range(const PriorAxes& axes, const WalkerUnits& units);

// The state of a walk that follows a plan.
struct PlanProgress {
  double time = 0;          // s, of the last transfer
  double speed = 0;         // m/s, present target; 0: the walk has not begun
  Eigen::VectorXd section;  // after the last transfer, units L = M = g = 1
};

// The first gait of a walk, at a time (s).
PriorGait first_gait(const GaitPrior& prior, const KneedParameters& parameters,
                     const WalkPlan& plan, double time, PlanProgress& progress);

// The gait of the step after a transfer that led to `state` at `time`. The target speed approaches
// the planned one. When it decreases, it does so more slowly the further the walker is from the
// intended gait, and not at all while it is far and still approaching it. Without this a walker
// falls when it is slowed down (from 1.3 to 0.7 m/s at 0.1 m/s^2 within 6 s).
PriorGait next_gait(const GaitPrior& prior, const KneedParameters& parameters, const WalkPlan& plan,
                    double time, const KneedState& state, PlanProgress& progress);

// The same for the anthropomorphic walker.
StraightGait first_gait(const StraightPrior& prior, const StraightLeggedParameters& parameters,
                        const WalkPlan& plan, double time, PlanProgress& progress);
StraightGait next_gait(const StraightPrior& prior, const StraightLeggedParameters& parameters,
                       const WalkPlan& plan, double time, const StraightState& state,
                       PlanProgress& progress);

}  // namespace gait
}  // namespace walktrack
