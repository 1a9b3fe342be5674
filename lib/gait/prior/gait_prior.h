// The prior over gaits: optimal cyclic gaits over speed x step length x slope, interpolated, for a
// walker of any size. A table in units L = M = g = 1 is part of the program.
//
// Speed and step length are those of the body: the advance of the hips (and of the foot plants).
#pragma once

#include "gait/feedback.h"
#include "gait/gait_noise.h"
#include "gait/prior/prior_table.h"

namespace walktrack {
inline namespace gait {

struct GaitNode {
  GaitVector gait = GaitVector::Zero();
  FeedbackGain gain = FeedbackGain::Zero();
  bool cyclic = false;           // an exact cycle; otherwise extrapolated from neighbours
  bool valid = false;            // a cycle within the limits of people's gaits (ValidGait)
  double cost_of_transport = 0;  // of the walker's joints and toe-off
  double clearance = 0;          // leg lengths
  double swing_flexion = 0;      // rad
  double stance_flexion = 0;     // rad
  double multiplier = 0;         // largest absolute Floquet multiplier without feedback
};

using GaitPrior = PriorTable<GaitNode>;

// The table of this program. It takes milliseconds; keep the result.
GaitPrior load_gait_prior();

// A gait of one walker, in its SI units.
struct PriorGait {
  double speed = 0;        // m/s, as wanted but within the table
  double step_length = 0;  // m, the same
  double slope = 0;        // rad, downhill, the same
  double period = 0;       // s, of a step
  KneedControls controls;
  KneedState start;  // just after a support transfer, contact at x0 = 0
  double cost_of_transport = 0;
  double clearance = 0;  // m
  double multiplier = 0;
  bool valid = false;  // whether all nodes around it are
  WalkerUnits units;
  GaitVector vector = GaitVector::Zero();
  FeedbackGain gain = FeedbackGain::Zero();
};

// The gait at a speed (m/s) and step length (m) on the slope of `parameters`. Values outside the
// table are clamped to its limits, step lengths without cyclic gaits are moved towards the
// preferred one. It takes some microseconds, so that it can be called for a particle at every
// transfer.
PriorGait gait_at(const GaitPrior& prior, const KneedParameters& parameters, double speed,
                  double step_length);

// The state of the undisturbed gait after a share (0..1) of a step.
KneedState state_at_phase(const KneedModel& model, const PriorGait& gait, double phase);

// The next step's controls after a transfer that led to `state`: the gait's own, corrected by
// `strength` (0 none, 1 full) of the feedback. Corrections are limited (see kMaxCorrection).
KneedControls next_controls(const PriorGait& gait, const KneedState& state, double strength = 1);

// Draws controls of which no stiffness, damping or impulse is negative (truncated at 3 sd and at
// zero).
KneedControls draw_controls(Rng& rng, const KneedControls& controls, const GaitNoise& noise);

// Log-density of `drawn` under draw_controls, per unit of stiffness relative to `controls`, damping
// and impulse likewise, and per rad of rest angle; see gait_noise.h.
double log_density(const KneedControls& drawn, const KneedControls& controls,
                   const GaitNoise& noise);

// Generalised torques of independent joint torques that are constant for `duration` s. Their sd is
// proportional to 1 / sqrt(duration), so that the walker's diffusion does not depend on the frame
// rate.
Vector5 draw_torques(Rng& rng, const WalkerUnits& units, const GaitNoise& noise, double duration);

}  // namespace gait
}  // namespace walktrack
