// The pose of a body of constant lengths that fits measured joint centres, whose bones change their
// lengths with the measurement's errors: inverse kinematics as least squares,
//   sum over hips, knees and ankles of |f_j(x) - y_j|^2 / sd^2
//   + sum over toes and neck of |f_j(x) - e_j|^2 / (kEndSpread sd)^2 + |(x - x0) / s|^2,
// f forward kinematics, y the measured centres, e the point at the body's own distance from ankle
// or pelvis in the measured direction (tools differ in where on a foot or neck their point is), x0
// the angles of pose_from_joints() and s the deviations of people's poses from a walker's, for what
// the centres leave open (the rotation of a straight leg). Gauss and Newton's steps.
//
// Metres, radians, world axes.
#pragma once

#include <optional>

#include "body/motion.h"
#include "tracker/state/free_numbers.h"

namespace walktrack {
inline namespace tracker {

// Standard deviation of toes and neck, in those of the other joints. By hand.
inline constexpr double kEndSpread = 1.5;

struct JointFit {
  Pose pose;
  Eigen::MatrixXd information;  // of the joint centres, by free number
};

// nullopt if a hip, knee or ankle is unknown. `sd` > 0, m.
std::optional<JointFit> fit_joints(const BodyModel& model, const JointPositions& measured,
                                   double sd);

// The subject, whose thighs, shanks and hip width, and with known arms also trunk, shoulder width,
// upper arms and forearms, have the motion's median lengths, unless they are stated.
Subject with_lengths_of(const Motion& motion, Subject subject);

}  // namespace tracker
}  // namespace walktrack
