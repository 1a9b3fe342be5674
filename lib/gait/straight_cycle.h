// Cyclic gaits of the anthropomorphic walker with Kuo's proportions (StraightLeggedParameters), in
// units L = M = g = 1.
//
// Just after a transfer both feet are on the ground, so that the legs' angles are opposite and
// three numbers determine the state: the section (angle of the swing leg, rates of stance and swing
// leg). Two controls are free, stiffness and toe-off impulse. With the section these are five
// numbers, for the five conditions that the section repeats with a given step length and period.
// Nothing is left to optimise, but there are several solutions (straight_prior.h).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "gait/prior/prior_table.h"
#include "walker/straight/straight_batch.h"

namespace walktrack {
inline namespace gait {

inline constexpr int kStraightControlSize = 2;
inline constexpr int kStraightSectionSize = 3;
inline constexpr int kStraightGaitSize = kStraightControlSize + kStraightSectionSize;
// Stiffness, toe-off impulse, then the section.
using StraightGaitVector = Eigen::Matrix<double, kStraightGaitSize, 1>;
using StraightSection = Eigen::Matrix<double, kStraightSectionSize, 1>;
// Derivatives of (section after a step - section before, advance, period) by the gait.
using StraightJacobian = Eigen::Matrix<double, kStraightGaitSize, kStraightGaitSize>;
using StraightStepMatrix = Eigen::Matrix<double, kStraightSectionSize, kStraightSectionSize>;

// Kuo's walker on a slope.
StraightModel straight_unit_model(double slope);

StraightControls straight_controls_from(const StraightGaitVector& gait);
StraightState straight_state_from(const StraightSection& section);
StraightSection section_of(const StraightState& state);

struct StraightStep {
  StraightSection end;
  double advance = 0, period = 0;
  double toe_off_work = 0;
  double least_normal = 0;     // smallest normal ground reaction
  bool old_foot_lifts = true;  // at the transfer
};

// nullopt if the walker falls, diverges or takes longer than any step.
std::optional<StraightStep> straight_step(const StraightModel& model,
                                          const StraightGaitVector& gait);

// Section, step length and period after a step minus those of the target.
StraightGaitVector cycle_residual(const StraightGaitVector& gait, const StraightStep& step,
                                  const GaitTarget& target);

// Central differences, all steps in one batch.
std::optional<StraightJacobian> cycle_jacobian(const StraightModel& model,
                                               const StraightGaitVector& gait);

StraightStepMatrix step_matrix(const StraightJacobian& jacobian);
// Its largest absolute eigenvalue.
double largest_multiplier(const StraightJacobian& jacobian);

// The cycle at a target near `guess`, of the family whose Jacobian has a negative determinant;
// nullopt if Newton's method finds none.
std::optional<StraightGaitVector> find_straight_cycle(const StraightGaitVector& guess,
                                                      const GaitTarget& target);

}  // namespace gait
}  // namespace walktrack
