// The prior over gaits of the anthropomorphic walker: stiffness and toe-off impulse (kappa, iota)
// of its cyclic gaits over speed x step length x slope. A table in units L = M = g = 1 is part of
// the program. It corresponds to gait_prior.h for the kneed walker.
//
// Two controls are determined by speed and step length, so that nothing is left to optimise. But
// the solution is not unique: if the swing leg makes one swing in a step there are two cycles, one
// stable and one not, with the same cost except for 4 % from 0.9 m/s on; with a stiffer spring
// there are two more, unstable, whose leg swings back and forth. The table contains the stable one
// with one swing: the sign of the Jacobian's determinant (straight_cycle.h) distinguishes the two,
// and it does not change along the continuation from the published cycle of Kuo (2002).
#pragma once

#include "gait/gait_noise.h"
#include "gait/prior/prior_table.h"
#include "gait/straight_cycle.h"

namespace walktrack {
inline namespace gait {

using StraightGain = Eigen::Matrix<double, kStraightControlSize, kStraightSectionSize>;

struct StraightNode {
  StraightGaitVector gait = StraightGaitVector::Zero();
  StraightGain gain = StraightGain::Zero();  // of the feedback at support transfer, feedback.h
  bool cyclic = false;                       // an exact cycle; otherwise copied from a neighbour
  bool valid = false;  // a cycle without braking (impulse >= 0), without a spring that drives legs
                       // apart (stiffness >= 0), and with a ground that never pulls
  double cost_of_transport = 0;  // work of the toe-off; the spring returns its work
  double least_normal = 0;       // smallest normal ground reaction, of the weight
  double multiplier = 0;         // largest absolute Floquet multiplier without feedback
};

using StraightPrior = PriorTable<StraightNode>;

// The table of this program.
StraightPrior load_straight_prior();

// Kuo's proportions with the leg of an average adult of this stature (m) and the mass (kg), on a
// slope (rad, positive downhill).
StraightLeggedParameters adult_straight_walker(double height, double mass, double slope = 0);
// Kuo's proportions with these units, on level ground.
StraightLeggedParameters straight_walker(const WalkerUnits& units);

// L is the standing hip height.
WalkerUnits walker_units(const StraightLeggedParameters& parameters);

// A gait of one walker, in its SI units.
struct StraightGait {
  double speed = 0;        // m/s, as wanted but within the table
  double step_length = 0;  // m, the same
  double slope = 0;        // rad, downhill, the same
  double period = 0;       // s, of a step
  StraightControls controls;
  StraightState start;  // just after a support transfer, contact at x0 = 0
  double cost_of_transport = 0;
  double multiplier = 0;
  bool valid = false;  // whether all nodes around it are
  WalkerUnits units;
  StraightGaitVector vector = StraightGaitVector::Zero();
  StraightGain gain = StraightGain::Zero();
};

// The gait at a speed (m/s) and step length (m) on the slope of `parameters`. Values outside the
// table are clamped to its limits, step lengths without valid gaits moved to the nearest with one.
StraightGait gait_at(const StraightPrior& prior, const StraightLeggedParameters& parameters,
                     double speed, double step_length);

// The state of the undisturbed gait after a share (0..1) of a step.
StraightState state_at_phase(const StraightModel& model, const StraightGait& gait, double phase);

// The section of a state of this gait's walker, in units L = M = g = 1.
StraightSection section_of(const StraightGait& gait, const StraightState& state);

// The next step's controls after a transfer that led to `state`: the gait's own, corrected by
// `strength` (0 none, 1 full) of the feedback, within 40 % of stiffness and impulse.
StraightControls next_controls(const StraightGait& gait, const StraightState& state,
                               double strength = 1);

// Draws that are never negative, their density per unit of stiffness and impulse relative to
// `controls`, and the generalised torque of a noisy hip: see gait_noise.h.
StraightControls draw_controls(Rng& rng, const StraightControls& controls, const GaitNoise& noise);
double log_density(const StraightControls& drawn, const StraightControls& controls,
                   const GaitNoise& noise);
Vector2 draw_hip_torque(Rng& rng, const WalkerUnits& units, const GaitNoise& noise,
                        double duration);

}  // namespace gait
}  // namespace walktrack
