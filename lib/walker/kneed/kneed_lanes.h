// A vector of kneed walkers and its operations in vector instructions; internal to lib/walker.
// kneed_batch.cpp assigns walkers to lanes.
#pragma once

#include "walker/lanes/lanes.h"

namespace walktrack {
inline namespace walker {

// The sums of a model that are needed for pairs of parts (kneed_lanes-inl.h).
struct LaneModel {
  double along[5], across[5];               // kg m, first moments
  double diagonal[5];                       // kg m^2
  double shank_along, shank_across, thigh;  // m, links
  double radius, mass, gravity_x, gravity_z;
};

// Springs of torso, hip, stance knee, swing knee; generalised torques of (torso, stance thigh,
// swing thigh, stance flexion, swing flexion).
struct LaneForces {
  LaneRows<4> stiffness, damping, offset;  // offset = stiffness rest
  LaneRows<5> noise;
};

// Walkers at one time each, with the results of an evaluation there.
struct LanePoint {
  LaneRows<5> q, qd, qdd;                      // torso, thighs, flexions
  LaneRows<2> stop_torque;                     // KneedAcceleration
  LaneRows<1> height, lead, height_rate, hip;  // SwingFoot; the hip's height, m
};

struct Lanes : LaneGroup {
  LanePoint at;
  LaneForces forces;
  LaneRows<2> held;  // 1 for a knee at its stop
  LaneRows<1> clearance;
};

// Limits beyond which a walker has fallen.
struct LaneBounds {
  double least_hip, max_lean;  // m, rad
};

// Evaluates accelerations and other results at lanes.at.
void evaluate_lanes(const LaneModel& model, Lanes& lanes);

// kneed_step_size() of every lane.
void lane_step_sizes(const LaneModel& model, const Lanes& lanes, double max_step, double* sizes);

// The state after a sub-step of h[lane].
void step_lanes_to(const LaneModel& model, const Lanes& lanes, const double* h, LanePoint& end);

// The length of every lane's next sub-step: an even share of the time that remains.
void next_lane_steps(const Lanes& lanes, double* h);

// One sub-step of every live lane. Lanes that diverge or may have an event within it keep their
// state; `ended` have no time left or have fallen.
LaneVerdict sub_step_lanes(const LaneModel& model, const LaneBounds& bounds, Lanes& lanes);

}  // namespace walker
}  // namespace walktrack
