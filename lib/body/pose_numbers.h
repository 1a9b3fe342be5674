// A pose as a vector: the table of its numbers. Code that weights, smooths, fits or compares all
// numbers of a pose iterates over this table.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "body/pose.h"
#include "core/conventions.h"

namespace walktrack {
inline namespace body {

enum class Unit { kMetre, kRadian };
enum class Limb { kTrunk, kLeg, kArm };

struct PoseNumber {
  std::string_view name;
  Unit unit = Unit::kRadian;
  // Standard deviation of the difference between a person's number and that of the walker that fits
  // them, in the unit. By hand; with all halved the error is 13.1 mm and with all doubled 14.5 mm
  // on the generated walks (tracker/reports/reported_pose.md).
  double spread = 0;
  // Root mean square of its acceleration in people who walk, unit / s^2: from the eight walks of
  // motion capture that were used for development (tracker/reports/reported_pose.md). Hips'
  // rotation and arms by hand.
  double acceleration = 0;
  bool sideways = false;  // leaves the upright plane of the heading
  bool turns = false;     // values that differ by a whole turn are equal
  double lowest = -std::numeric_limits<double>::infinity();

  // Its member in a pose: one of these.
  int axis = 0;
  double Pose::*trunk = nullptr;
  double LegPose::*leg = nullptr;
  double ArmPose::*arm = nullptr;
  Side side = Side::kLeft;

  constexpr Limb limb() const {
    return leg != nullptr ? Limb::kLeg : arm != nullptr ? Limb::kArm : Limb::kTrunk;
  }
  template <typename PoseT>
  auto& in(PoseT& pose) const {
    if (leg != nullptr) return pose.legs[static_cast<size_t>(side)].*leg;
    if (arm != nullptr) return pose.arms[static_cast<size_t>(side)].*arm;
    return trunk != nullptr ? pose.*trunk : pose.root[axis];
  }
  // The difference between two values of the number, the smaller one for angles that turn.
  double difference(double from, double to) const {
    return turns ? std::remainder(to - from, 2 * kPi) : to - from;
  }
};

namespace pose_numbers {

constexpr PoseNumber root(std::string_view name, int axis, double spread, double acceleration) {
  PoseNumber out{
      .name = name, .unit = Unit::kMetre, .spread = spread, .acceleration = acceleration};
  out.axis = axis;
  return out;
}
constexpr PoseNumber trunk(std::string_view name, double Pose::*trunk, double spread,
                           double acceleration, bool sideways) {
  PoseNumber out{
      .name = name, .spread = spread, .acceleration = acceleration, .sideways = sideways};
  out.trunk = trunk;
  return out;
}
constexpr PoseNumber heading(double spread, double acceleration) {
  PoseNumber out = trunk("heading", &Pose::heading, spread, acceleration, true);
  out.turns = true;
  return out;
}
constexpr PoseNumber leg(std::string_view name, Side side, double LegPose::*angle, double spread,
                         double acceleration, bool sideways = false) {
  PoseNumber out{
      .name = name, .spread = spread, .acceleration = acceleration, .sideways = sideways};
  out.leg = angle;
  out.side = side;
  return out;
}
constexpr PoseNumber knee(std::string_view name, Side side, double spread, double acceleration) {
  PoseNumber out = leg(name, side, &LegPose::knee_flexion, spread, acceleration);
  out.lowest = 0;  // knees do not bend backwards
  return out;
}
constexpr PoseNumber arm(std::string_view name, Side side, double ArmPose::*angle, double spread,
                         double acceleration, bool sideways = false) {
  PoseNumber out{
      .name = name, .spread = spread, .acceleration = acceleration, .sideways = sideways};
  out.arm = angle;
  out.side = side;
  return out;
}

}  // namespace pose_numbers

inline constexpr std::array kPoseNumbers{
    // Single numbers: name, axis or angle, spread, acceleration, sideways.
    pose_numbers::root("root_x", 0, .02, 2.7),
    pose_numbers::root("root_y", 1, .02, 2.7),
    pose_numbers::root("root_z", 2, .01, 2.5),
    pose_numbers::heading(.09, 4),
    pose_numbers::trunk("list", &Pose::list, .035, 5, true),
    pose_numbers::trunk("tilt", &Pose::tilt, .05, 5, false),
    // Numbers of each side: name, side, angle, spread, acceleration, sideways.
    pose_numbers::leg("lhip_flexion", Side::kLeft, &LegPose::hip_flexion, .09, 20),
    pose_numbers::leg("lhip_abduction", Side::kLeft, &LegPose::hip_abduction, .05, 10, true),
    pose_numbers::leg("lhip_rotation", Side::kLeft, &LegPose::hip_rotation, .09, 10, true),
    pose_numbers::knee("lknee_flexion", Side::kLeft, .14, 50),
    pose_numbers::leg("lankle_dorsiflexion", Side::kLeft, &LegPose::ankle_dorsiflexion, .17, 50),
    pose_numbers::leg("rhip_flexion", Side::kRight, &LegPose::hip_flexion, .09, 20),
    pose_numbers::leg("rhip_abduction", Side::kRight, &LegPose::hip_abduction, .05, 10, true),
    pose_numbers::leg("rhip_rotation", Side::kRight, &LegPose::hip_rotation, .09, 10, true),
    pose_numbers::knee("rknee_flexion", Side::kRight, .14, 50),
    pose_numbers::leg("rankle_dorsiflexion", Side::kRight, &LegPose::ankle_dorsiflexion, .17, 50),
    pose_numbers::arm("lshoulder_flexion", Side::kLeft, &ArmPose::shoulder_flexion, .26, 15),
    pose_numbers::arm("lshoulder_abduction", Side::kLeft, &ArmPose::shoulder_abduction, .17, 15,
                      true),
    pose_numbers::arm("lelbow_flexion", Side::kLeft, &ArmPose::elbow_flexion, .26, 15),
    pose_numbers::arm("rshoulder_flexion", Side::kRight, &ArmPose::shoulder_flexion, .26, 15),
    pose_numbers::arm("rshoulder_abduction", Side::kRight, &ArmPose::shoulder_abduction, .17, 15,
                      true),
    pose_numbers::arm("relbow_flexion", Side::kRight, &ArmPose::elbow_flexion, .26, 15),
};
static_assert(sizeof(Pose) == kPoseNumbers.size() * sizeof(double), "a row for every number");

}  // namespace body
}  // namespace walktrack
