// Joint angles from a pose, with the names of gait laboratories and OpenSim.
//
// Grood & Suntay's joint coordinate systems in the order that the ISB recommends for the leg (Wu et
// al., J. Biomech. 35, 2002) and that OpenSim's Rajagopal and Lai models use: flexion about the
// parent's lateral axis, then adduction, then rotation about the child's long axis; body-fixed
// rotations z, x, y in OpenSim's axes (x forward, y up, z right). Zero is the upright pose with the
// feet flat and pointing ahead. README.md beside this file draws axes and signs. Radians.
#pragma once

#include <array>
#include <string_view>

#include <Eigen/Core>

#include "body/pose.h"

namespace walktrack {
inline namespace body {

enum JointAngle {
  kPelvisTilt,      // + upper end backwards, against the ground
  kPelvisList,      // + right side down
  kPelvisRotation,  // + turned left, from the world's x axis
  kHipFlexionR,     // + thigh forwards
  kHipAdductionR,   // + towards the other leg
  kHipRotationR,    // + toes inwards
  kKneeAngleR,      // + flexion
  kAnkleAngleR,     // + dorsiflexion
  kHipFlexionL,
  kHipAdductionL,
  kHipRotationL,
  kKneeAngleL,
  kAnkleAngleL,
  kLumbarExtension,  // trunk against pelvis: + backwards
  kLumbarBending,    // + to the right
  kLumbarRotation,   // + to the left
  kTrunkTilt,        // trunk against the ground: + backwards
  kJointAngleCount
};
inline constexpr std::array<std::string_view, kJointAngleCount> kJointAngleNames{
    "pelvis_tilt",     "pelvis_list",  "pelvis_rotation", "hip_flexion_r",    "hip_adduction_r",
    "hip_rotation_r",  "knee_angle_r", "ankle_angle_r",   "hip_flexion_l",    "hip_adduction_l",
    "hip_rotation_l",  "knee_angle_l", "ankle_angle_l",   "lumbar_extension", "lumbar_bending",
    "lumbar_rotation", "trunk_tilt"};
using JointAngles = std::array<double, kJointAngleCount>;

JointAngles joint_angles(const Pose& pose);

// A point of the world in OpenSim's ground, x forward, y up, z right: (x, z, -y).
inline Eigen::Vector3d opensim_from_world(const Eigen::Vector3d& point) {
  return {point.x(), point.z(), -point.y()};
}

}  // namespace body
}  // namespace walktrack
