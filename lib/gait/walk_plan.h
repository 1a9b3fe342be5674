// A walk out of the table of gaits: how fast it is to be when, and which gait that asks for.
#pragma once

#include <vector>

#include "gait/prior/gait_prior.h"
#include "gait/prior/straight_prior.h"

namespace walktrack {
inline namespace gait {

struct SpeedChange {
  double time = 0;   // s, when the change begins
  double speed = 0;  // m/s, of the body
};

struct WalkPlan {
  double speed = 1.3;                // m/s, of the body
  std::vector<SpeedChange> changes;  // times ascend
  double step_length = 0;            // m; 0: what people prefer at the speed
  double feedback = 1;               // strength, 0 switches it off
  double acceleration = 0.2;         // m/s^2, at most: see next_gait()
};

// The speed that a plan asks for at a time.
double planned_speed(const WalkPlan& plan, double time);

// Slowest and fastest speed of a table for a body, m/s.
struct SpeedRange {
  double least, most;
};
SpeedRange speed_range(const PriorAxes& axes, const WalkerUnits& units);

// How far a walk has followed its plan; starts with the plan's first speed.
struct PlanProgress {
  double time = 0;          // s, of the last transfer
  double speed = 0;         // m/s, aimed at; 0: the walk has not begun
  Eigen::VectorXd section;  // after the last transfer, units L = M = g = 1
};

// The gait with which a walk begins, at a time (s).
PriorGait first_gait(const GaitPrior& prior, const KneedParameters& parameters,
                     const WalkPlan& plan, double time, PlanProgress& progress);

// The gait of the step after a transfer that left `state` at `time`. The speed aimed at goes
// towards the planned one; downwards the slower the further the walker lags behind the gait it aims
// at, and not at all while it lags far and still moves towards it. A walker that is hurried to slow
// down falls (from 1.3 to 0.7 m/s at 0.1 m/s^2 within 6 s), one that is waited for does not.
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
