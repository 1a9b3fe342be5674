// A vector of anthropomorphic walkers and its operations in vector instructions; internal to
// lib/walker. straight_batch.cpp assigns walkers to lanes.
#pragma once

#include "walker/lanes/lanes.h"
#include "walker/straight/straight_walker.h"

namespace walktrack {
inline namespace walker {

struct StraightLanePoint {
  LaneRows<2> q, qd, qdd;
};

struct StraightLanes : LaneGroup {
  StraightLanePoint at;
  LaneRows<1> stiffness;
  LaneRows<2> noise;
};

// Accelerations at lanes.at.
void evaluate_lanes(const StraightModel& model, StraightLanes& lanes);

// The largest sub-step of RK4 at lanes.at: small relative to the spring's oscillation.
void lane_step_sizes(const StraightModel& model, const StraightLanes& lanes, double max_step,
                     double* sizes);

// The state after a sub-step of h[lane].
void step_lanes_to(const StraightModel& model, const StraightLanes& lanes, const double* h,
                   StraightLanePoint& end);

// The length of every lane's next sub-step: an even share of the time that remains.
void next_lane_steps(const StraightLanes& lanes, double* h);

// One sub-step of every live lane. Lanes that diverge or strike within it keep their state; `ended`
// have no time left or have fallen.
LaneVerdict sub_step_lanes(const StraightModel& model, StraightLanes& lanes);

}  // namespace walker
}  // namespace walktrack
