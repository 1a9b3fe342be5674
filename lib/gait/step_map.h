// One step of the kneed walker as a map from transfer to transfer, in units L = M = g = 1.
//
// Just after a transfer of a normal step both feet are on the ground and the new stance knee is at
// its stop, so that eight numbers determine the state: the section (torso, stance thigh and swing
// thigh angles, five rates). The stance shank follows the thigh; the swing shank follows from the
// contact of the swing foot with the ground.
//
// Controls are optimised and interpolated as square roots of stiffness and damping: these are never
// negative, and smooth at zero.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "walker/kneed/kneed_advance.h"

namespace walktrack {
inline namespace gait {

inline constexpr int kSectionSize = 8;
inline constexpr int kControlSize = 13;
using SectionVector = Eigen::Matrix<double, kSectionSize, 1>;
using ControlVector = Eigen::Matrix<double, kControlSize, 1>;

// (sqrt stiffness, sqrt damping, rest) of torso, hip, stance knee, swing knee; toe-off impulse.
KneedControls controls_from(const ControlVector& vector);

SectionVector section_of(const KneedState& state);
// nullopt if the swing foot cannot reach the ground.
std::optional<KneedState> state_from(const KneedModel& model, const SectionVector& section);

struct StepMeasures {
  double length = 0;          // advance of the body
  double period = 0;          //
  double clearance = 0;       // of the swing foot, at its lowest local minimum
  double swing_flexion = 0;   // rad, largest of the knee
  double stance_flexion = 0;  // rad
  double positive_work = 0;   // of all joint torques
  double squared_torque = 0;  // time integral of their squares
  double least_normal = 0;    // smallest normal ground reaction
  double largest_lean = 0;    // rad, of the torso either way
};

struct WalkedStep {
  SectionVector end;
  StepMeasures measures;
  double knee_gap = 0;  // rad, flexion of the new stance knee: 0 on the section
};

// Integration steps: 1 ms for an adult, for which a cycle is exact to 1e-7, and 2 ms for searching.
inline constexpr double kFineStep = 0.00325;
inline constexpr double kCoarseStep = 0.0065;

// nullopt if the walker falls, diverges or takes longer than any step.
std::optional<WalkedStep> walk_step(const KneedModel& model, const KneedControls& controls,
                                    const KneedState& start, double max_step = kFineStep);

}  // namespace gait
}  // namespace walktrack
