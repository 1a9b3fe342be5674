// Cyclic gaits: controls and a state after transfer that one step maps to itself, with a given
// speed and step length. Units L = M = g = 1 (walker_units.h).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "gait/prior/prior_table.h"
#include "gait/step_map.h"

namespace walktrack {
inline namespace gait {

inline constexpr int kGaitSize = kControlSize + kSectionSize;
inline constexpr int kResidualSize = kSectionSize + 2;
// Controls, then section.
using GaitVector = Eigen::Matrix<double, kGaitSize, 1>;
// Section after a step minus section before; advance - step length; period - step length / speed.
using CycleResidual = Eigen::Matrix<double, kResidualSize, 1>;
using CycleJacobian = Eigen::Matrix<double, kResidualSize, kGaitSize>;
using SectionMatrix = Eigen::Matrix<double, kSectionSize, kSectionSize>;

// One step of a gait vector; nullopt if it cannot start, does not end with a transfer, or ends off
// the section (the swing knee is not straight at the strike).
std::optional<WalkedStep> step_of(const KneedModel& model, const GaitVector& gait,
                                  double max_step = kFineStep);

CycleResidual cycle_residual(const GaitVector& gait, const WalkedStep& step,
                             const GaitTarget& target);

// Central differences of the residual (which does not depend on the target).
std::optional<CycleJacobian> cycle_jacobian(const KneedModel& model, const GaitVector& gait);

// Minimum-norm Gauss-Newton from `guess` to the exact cycle (residual below 1e-9); nullopt if it
// does not converge.
std::optional<GaitVector> find_cycle(const KneedModel& model, const GaitVector& guess,
                                     const GaitTarget& target);

// The unit walker (walker_units.h) on the target's slope; the model of all functions here.
KneedModel unit_model(const GaitTarget& target);

// Continues a cycle along the straight line between two targets in as few steps as Newton's method
// allows.
std::optional<GaitVector> continue_cycle(const GaitVector& gait, const GaitTarget& from,
                                         const GaitTarget& to);

// Derivative of the section after a step by the section before it, from a cycle's Jacobian.
SectionMatrix step_matrix(const CycleJacobian& jacobian);

// Absolute values of its eigenvalues (the Floquet multipliers), largest first.
SectionVector multipliers(const SectionMatrix& step_matrix);

}  // namespace gait
}  // namespace walktrack
