// What is known of walks before any image about the direction across them, in which one camera sees
// least: people sway little to the side, and their knees and ankles are below their hips.
//
// From motion capture of 23 people who walk, 15 of them patients: knees are .044 of the stature to
// the side of the pelvis, standard deviation .020, ankles .022 and .026, of which half is a
// person's own and half changes within the stride. Before one camera it counts for particles
// (frame_likelihood.h), and always in the trajectory (smooth/trajectory.h). Directions are
// horizontal; metres.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "body/kinematics.h"

namespace walktrack {
inline namespace tracker {

// The direction in which somebody walks, a unit vector over the ground; nullopt if they do not.
using WalkingDirection = std::optional<Eigen::Vector2d>;

// Of somebody who moves like this, m/s.
WalkingDirection walking_direction(const Eigen::Vector2d& velocity);

// For each of the places of somebody's pelvis over the ground, `dt` s apart: from half a second
// before to half a second after it.
std::vector<WalkingDirection> walking_directions(std::span<const Eigen::Vector2d> places,
                                                 double dt);

// Left knee, right knee, left ankle, right ankle.
using LegsAside = Eigen::Vector4d;

// How much further to their own side of the pelvis they are than people's, in standard deviations,
// of a body of that stature.
LegsAside legs_aside(const JointPositions& joints, double stature, const Eigen::Vector2d& ahead);

// They change within a stride: their probability counts once in so many seconds.
inline constexpr double kLegsAsideTime = 0.1;

}  // namespace tracker
}  // namespace walktrack
