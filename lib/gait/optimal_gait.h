// The stable cyclic gait of least cost at a speed, step length and slope: the objective and its
// optimisation. Units L = M = g = 1.
//
// The cycle conditions leave 11 of the 21 numbers of a gait free. The optimisation moves in the
// tangent plane of the cycles, returns to them by a chord Newton iteration with the plane's own
// pseudo-inverse, and leaves the choice of trial points to BOBYQA (M. J. D. Powell 2009; NLopt),
// which needs no derivatives of an objective that contains eigenvalues and maxima.
#pragma once

#include <optional>

#include "gait/cycle.h"

namespace walktrack {
inline namespace gait {

// Every term is dimensionless and near 0.05 where it becomes important, which is the cost of
// transport of a good gait. Limits are soft: cost weight * (excess / scale)^2.
struct GaitObjective {
  double torque = 2;             // of the squared torques per distance: about a tenth of the work's
                                 // share, enough to prefer soft joints with equal work
  double stability = 0.5;        // of log(growth / allowed_growth)^2
  double allowed_growth = 0.75;  // per step: below 1 is stable, noise needs a margin
  double clearance = 0.3;        // for heights of the swing foot below
  double least_clearance = 0.019;     // 1.8 cm for an adult; people keep 1 to 2 cm
  double knee = 0.05;                 // for flexions outside of
  double least_swing_flexion = 0.98;  // rad (56 deg; people 60)
  double most_swing_flexion = 1.13;   // rad (65 deg)
  double most_stance_flexion = 0.28;  // rad (16 deg)
  double knee_scale = 0.1;            // rad
  double lean = 0.05;                 // for a lean of the torso above
  double most_lean = 0.07;            // rad (4 deg)
  double lean_scale = 0.05;           // rad
  double normal = 0.05;               // for ground reactions below
  double least_normal = 0.2;          // of body weight
  double normal_scale = 0.1;
};

// Positive joint work plus toe-off work (impulse^2 / 2M), per distance and weight.
double cost_of_transport(const GaitVector& gait, const WalkedStep& step);

// Growth of a deviation per step: |A^8|^(1/8) of the step matrix, a smooth upper bound of its
// spectral radius that includes transient growth.
double growth_per_step(const SectionMatrix& step_matrix);

// Without the stability term.
double gait_cost(const GaitObjective& objective, const GaitVector& gait, const WalkedStep& step);

// The complete objective for a cycle; kUnwalkable if a step or a difference of steps fails.
inline constexpr double kUnwalkable = 5;  // by hand: any walking gait costs less
double objective_value(const KneedModel& model, const GaitObjective& objective,
                       const GaitVector& gait);

struct GaitSearch {
  int rounds = 6;            // tangent planes one after the other
  int trials = 120;          // evaluations in one plane
  double radius = 0.1;       // of the box in one plane
  double worthwhile = 0.01;  // a round with a smaller improvement is the last
  double attraction = 0;     // weight of the squared distance of the controls from `centre`
  GaitVector centre = GaitVector::Zero();
};

// Improves a cycle. Returns the given one if no better one was found.
GaitVector optimal_gait(const GaitVector& cycle, const GaitTarget& target,
                        const GaitObjective& objective, const GaitSearch& search);

}  // namespace gait
}  // namespace walktrack
