// The numbers of a pose that are free in a model, as a vector. Sideways numbers are constant on a
// sagittal path; arms are free for a body that has them.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "body/pose_numbers.h"
#include "tracker/state/particle.h"

namespace walktrack {
inline namespace tracker {

// Indices in kPoseNumbers, ascending.
using FreeNumbers = std::vector<size_t>;

// The first of them are the place of the root over the ground.
inline constexpr Eigen::Index kOverGround = 2;

FreeNumbers free_numbers(const BodyModel& model);

Eigen::VectorXd values_of(const FreeNumbers& free, const Pose& pose);

// The pose with these values, none below its lower limit.
Pose with_values(const FreeNumbers& free, Pose pose, const Eigen::VectorXd& values);

// From one pose to another, number by number; for angles that turn, by the shorter way.
Eigen::VectorXd difference(const FreeNumbers& free, const Pose& from, const Pose& to);

// PoseNumber::spread.
Eigen::VectorXd spreads_of(const FreeNumbers& free);

}  // namespace tracker
}  // namespace walktrack
