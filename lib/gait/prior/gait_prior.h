// The prior over gaits: optimal cyclic gaits over speed x step length x slope, interpolated, for a
// walker of any size. A table in units L = M = g = 1 ships inside the program.
//
// Speed and step length are those of the body: how far the hips (and the foot plants) advance.
#pragma once

#include "gait/feedback.h"
#include "gait/gait_noise.h"
#include "gait/prior/prior_table.h"

namespace walktrack {
inline namespace gait {

struct GaitNode {
  GaitVector gait = GaitVector::Zero();
  FeedbackGain gain = FeedbackGain::Zero();
  bool cyclic = false;           // an exact cycle; otherwise the gait continues its neighbours
  bool valid = false;            // a cycle within the limits that people keep (ValidGait)
  double cost_of_transport = 0;  // of the walker's joints and toe-off
  double clearance = 0;          // leg lengths
  double swing_flexion = 0;      // rad
  double stance_flexion = 0;     // rad
  double multiplier = 0;         // largest absolute Floquet multiplier without feedback
};

using GaitPrior = PriorTable<GaitNode>;

// The table of this program. Milliseconds; keep it.
GaitPrior load_gait_prior();

// A gait of one walker, in its SI units.
struct PriorGait {
  double speed = 0;        // m/s, as asked but within the table
  double step_length = 0;  // m, the same
  double slope = 0;        // rad, downhill, the same
  double period = 0;       // s, of a step
  KneedControls controls;
  KneedState start;  // just after a support transfer, contact at x0 = 0
  double cost_of_transport = 0;
  double clearance = 0;  // m
  double multiplier = 0;
  bool valid = false;  // all nodes around it are
  WalkerUnits units;
  GaitVector vector = GaitVector::Zero();
  FeedbackGain gain = FeedbackGain::Zero();
};

// The gait at a speed (m/s) and step length (m) on the slope of `parameters`. Values outside the
// table are moved to its border, step lengths without cyclic gaits towards the preferred one. Cheap
// (some microseconds): a particle may ask at every transfer.
PriorGait gait_at(const GaitPrior& prior, const KneedParameters& parameters, double speed,
                  double step_length);

// The state of the undisturbed gait after a share (0..1) of a step.
KneedState state_at_phase(const KneedModel& model, const PriorGait& gait, double phase);

// The share of a step that has passed since the last transfer, 0..1.
double phase_of(const PriorGait& gait, const KneedState& state);

// The next step's controls after a transfer that left `state`: the gait's own, corrected by
// `strength` (0 none, 1 full) of the feedback. Corrections are bounded (see kMaxCorrection).
KneedControls next_controls(const PriorGait& gait, const KneedState& state, double strength = 1);

// Draws that never make a spring, damper or impulse negative (truncated at 3 sd, and before zero).
KneedControls draw_controls(Rng& rng, const KneedControls& controls, const GaitNoise& noise);

// Logarithm of the density with which draw_controls draws `drawn`, per unit of stiffness relative
// to `controls`, damping and impulse likewise, and per rad of rest angle; see gait_noise.h.
double log_density(const KneedControls& drawn, const KneedControls& controls,
                   const GaitNoise& noise);

// Generalised torques of independent joint torques held for `duration` s. Their sd falls with
// sqrt(duration), so that the walker's diffusion does not depend on the frame rate.
Vector5 draw_torques(Rng& rng, const WalkerUnits& units, const GaitNoise& noise, double duration);

}  // namespace gait
}  // namespace walktrack
