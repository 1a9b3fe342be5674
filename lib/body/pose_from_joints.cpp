#include "body/pose_from_joints.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "body/motion.h"

namespace walktrack {
inline namespace body {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kFootWeight = 0.3;     // as much as a knee that is flexed by 17 degrees
constexpr double kShortestBone = 1e-6;  // m; below it a direction is undefined

// Signed angle from a to b about the unit vector `axis`.
double angle_about(const Vector3d& axis, const Vector3d& a, const Vector3d& b) {
  return std::atan2(axis.dot(a.cross(b)), a.dot(b) - axis.dot(a) * axis.dot(b));
}

Matrix3d frame(const Vector3d& up, const Vector3d& left) {
  Matrix3d out;
  out.col(2) = up;
  out.col(1) = (left - up * up.dot(left)).normalized();
  out.col(0) = out.col(1).cross(out.col(2));
  return out;
}

// R = Rx(abduction) Ry(-flexion) Rz(-rotation), signs of the left side.
void set_hip(const Matrix3d& pelvis_from_thigh, Side side, LegPose& leg) {
  const Matrix3d& r = pelvis_from_thigh;
  leg.hip_abduction = outward(side) * std::atan2(-r(1, 2), r(2, 2));
  leg.hip_flexion = -std::asin(std::clamp(r(0, 2), -1.0, 1.0));
  leg.hip_rotation = -outward(side) * std::atan2(-r(0, 1), r(0, 0));
}

void set_leg(const JointPositions& joints, const BodyLengths& lengths, Side side,
             const Matrix3d& world_from_pelvis, LegPose& leg) {
  const Vector3d axis = leg_hinge_axis(joints, side, world_from_pelvis.col(1));
  const Vector3d thigh = (joints[hip(side)] - joints[knee(side)]).normalized();
  const Vector3d shank = (joints[knee(side)] - joints[ankle(side)]).normalized();
  set_hip(world_from_pelvis.transpose() * frame(thigh, axis), side, leg);
  leg.knee_flexion = angle_about(axis, thigh, shank);
  if (!known(joints[toe(side)])) return;
  // Dorsiflexion lifts the toes: it is a rotation about the right-pointing axis from the neutral
  // direction of the foot.
  const Vector3d ball = joints[toe(side)] - joints[ankle(side)];
  const double neutral =
      std::atan2(lengths.ball_height - lengths.ankle_height, lengths.ball_forward);
  const Vector3d forward = axis.cross(shank);
  leg.ankle_dorsiflexion = std::atan2(ball.dot(shank), ball.dot(forward)) - neutral;
}

void set_arm(const JointPositions& joints, Side side, const Matrix3d& world_from_trunk,
             ArmPose& arm) {
  const bool left = side == Side::kLeft;
  const Vector3d& shoulder = joints[left ? Joint::kLeftShoulder : Joint::kRightShoulder];
  const Vector3d& elbow = joints[left ? Joint::kLeftElbow : Joint::kRightElbow];
  const Vector3d& wrist = joints[left ? Joint::kLeftWrist : Joint::kRightWrist];
  if (!known(shoulder) || !known(elbow) || !known(wrist)) return;
  const Vector3d upper = (world_from_trunk.transpose() * (shoulder - elbow)).normalized();
  const Vector3d fore = (world_from_trunk.transpose() * (elbow - wrist)).normalized();
  const double roll = std::atan2(-upper.y(), upper.z());
  arm.shoulder_abduction = outward(side) * roll;
  arm.shoulder_flexion = std::asin(std::clamp(-upper.x(), -1.0, 1.0));
  const Vector3d axis(0, std::cos(roll), std::sin(roll));
  arm.elbow_flexion = -angle_about(axis, upper, fore);
}

bool legs_known(const JointPositions& joints) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Vector3d thigh = joints[hip(side)] - joints[knee(side)];
    const Vector3d shank = joints[knee(side)] - joints[ankle(side)];
    if (!known(thigh) || !known(shank) || thigh.norm() < kShortestBone ||
        shank.norm() < kShortestBone)
      return false;
  }
  return (joints[Joint::kLeftHip] - joints[Joint::kRightHip]).norm() >= kShortestBone;
}

}  // namespace

Vector3d leg_hinge_axis(const JointPositions& joints, Side side, const Vector3d& left) {
  const Vector3d thigh = (joints[hip(side)] - joints[knee(side)]).normalized();
  const Vector3d shank = (joints[knee(side)] - joints[ankle(side)]).normalized();
  const Vector3d foot = shank.cross(joints[toe(side)] - joints[ankle(side)]).normalized();
  const Vector3d sideways = known(foot) ? foot : left;
  return (thigh.cross(shank) + kFootWeight * sideways).normalized();
}

std::optional<Pose> pose_from_joints(const JointPositions& joints, const BodyLengths& lengths) {
  if (!legs_known(joints)) return std::nullopt;
  Pose pose;
  pose.root = 0.5 * (joints[Joint::kLeftHip] + joints[Joint::kRightHip]);
  const Vector3d left = (joints[Joint::kLeftHip] - joints[Joint::kRightHip]).normalized();
  pose.heading = std::atan2(-left.x(), left.y());
  pose.list = std::asin(std::clamp(left.z(), -1.0, 1.0));
  const Joint top = known(joints[Joint::kNeck]) ? Joint::kNeck : Joint::kHead;
  const Vector3d trunk = joints[top] - pose.root;
  const Vector3d forward(std::cos(pose.heading), std::sin(pose.heading), 0);
  if (known(trunk)) pose.tilt = std::atan2(trunk.dot(forward), trunk.z());
  const Matrix3d heading(Eigen::AngleAxisd(pose.heading, Vector3d::UnitZ()));
  const Matrix3d list(Eigen::AngleAxisd(pose.list, Vector3d::UnitX()));
  const Matrix3d tilt(Eigen::AngleAxisd(pose.tilt, Vector3d::UnitY()));
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t i = static_cast<size_t>(side);
    set_leg(joints, lengths, side, heading * list * tilt, pose.legs[i]);
    set_arm(joints, side, heading * tilt, pose.arms[i]);
  }
  return pose;
}

}  // namespace body
}  // namespace walktrack
