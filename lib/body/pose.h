// One pose of the body in 3-D, and its joints.
//
// Sixteen numbers: root position (3), heading, list and tilt, and for each leg hip flexion,
// abduction and rotation, knee flexion, ankle dorsiflexion. While a foot is on the ground, the
// root's position follows from the foot (body/kinematics.h), so that 13 of them and the foot's
// position are free. Arms are an optional group. body/pose_numbers.h has a table of all numbers.
//
//   world_from_pelvis = Rz(heading) Rx(list) Ry(tilt)      world_from_trunk = Rz(heading) Ry(tilt)
//   pelvis_from_thigh = Rx(o * abduction) Ry(-hip_flexion) Rz(-o * rotation),
//                       o = +1 left, -1 right: abduction moves the foot outwards on either side,
//                       rotation > 0 turns the toes inwards
//   thigh_from_shank  = Ry(knee_flexion)
//   shank_from_foot   = Ry(-dorsiflexion)
// Angles in radians, positions in metres, world axes (core/conventions.h).
#pragma once

#include <array>
#include <string_view>

#include <Eigen/Core>

namespace walktrack {
inline namespace body {

enum class Side { kLeft = 0, kRight = 1 };

inline constexpr Side other(Side side) { return side == Side::kLeft ? Side::kRight : Side::kLeft; }

// The sign of y on that side of the body: +1 is left.
inline constexpr double outward(Side side) { return side == Side::kLeft ? 1.0 : -1.0; }

struct LegPose {
  double hip_flexion = 0, hip_abduction = 0, hip_rotation = 0;
  double knee_flexion = 0;
  double ankle_dorsiflexion = 0;
};

struct ArmPose {
  double shoulder_flexion = 0, shoulder_abduction = 0;
  double elbow_flexion = 0;
};

struct Pose {
  Eigen::Vector3d root = Eigen::Vector3d::Zero();  // midpoint of the hip centres
  double heading = 0;                              // from world x towards world y
  double list = 0;              // right side up is negative, about the forward axis
  double tilt = 0;              // trunk and pelvis, positive leans forward
  std::array<LegPose, 2> legs;  // by Side
  std::array<ArmPose, 2> arms;  // by Side; ignored by a body without arms
};

// The order of the columns of joints.csv.
enum class Joint {
  kPelvis,
  kNeck,
  kHead,
  kLeftHip,
  kLeftKnee,
  kLeftAnkle,
  kLeftToe,
  kRightHip,
  kRightKnee,
  kRightAnkle,
  kRightToe,
  kLeftShoulder,
  kLeftElbow,
  kLeftWrist,
  kRightShoulder,
  kRightElbow,
  kRightWrist,
};
inline constexpr int kJointCount = 17;
inline constexpr int kJointCountWithoutArms = 11;
inline constexpr std::array<std::string_view, kJointCount> kJointNames{
    "pelvis", "neck", "head",      "lhip",   "lknee",  "lankle",    "ltoe",   "rhip",  "rknee",
    "rankle", "rtoe", "lshoulder", "lelbow", "lwrist", "rshoulder", "relbow", "rwrist"};

inline constexpr Joint hip(Side s) { return s == Side::kLeft ? Joint::kLeftHip : Joint::kRightHip; }
inline constexpr Joint knee(Side s) {
  return s == Side::kLeft ? Joint::kLeftKnee : Joint::kRightKnee;
}
inline constexpr Joint ankle(Side s) {
  return s == Side::kLeft ? Joint::kLeftAnkle : Joint::kRightAnkle;
}
inline constexpr Joint toe(Side s) { return s == Side::kLeft ? Joint::kLeftToe : Joint::kRightToe; }

// Joint centres in the world, indexed by Joint. Without arms the last six stay at zero.
struct JointPositions {
  std::array<Eigen::Vector3d, kJointCount> at{};
  Eigen::Vector3d& operator[](Joint joint) { return at[static_cast<size_t>(joint)]; }
  const Eigen::Vector3d& operator[](Joint joint) const { return at[static_cast<size_t>(joint)]; }
};

}  // namespace body
}  // namespace walktrack
