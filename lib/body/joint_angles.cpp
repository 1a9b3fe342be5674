#include "body/joint_angles.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "body/kinematics.h"

namespace walktrack {
inline namespace body {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A rotation between body frames, with both converted from (forward, left, up) to (forward, up,
// right).
Matrix3d opensim_rotation(const Matrix3d& rotation) {
  Matrix3d turn;
  // clang-format off
  turn << 1,  0, 0,
          0,  0, 1,
          0, -1, 0;
  // clang-format on
  return turn * rotation * turn.transpose();
}

// Body-fixed angles R = Rz(a) Rx(b) Ry(c), b within a right angle:
// R(2,1) = sin b, R(0,1) = -sin a cos b, R(1,1) = cos a cos b, R(2,0) = -cos b sin c, ...
Vector3d zxy_angles(const Matrix3d& rotation) {
  const Matrix3d r = opensim_rotation(rotation);
  return {std::atan2(-r(0, 1), r(1, 1)), std::asin(std::clamp(r(2, 1), -1.0, 1.0)),
          std::atan2(-r(2, 0), r(2, 2))};
}

Matrix3d about(const Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

Matrix3d world_from_trunk(const Pose& pose) {
  return about(Vector3d::UnitZ(), pose.heading) * about(Vector3d::UnitY(), pose.tilt);
}

Matrix3d pelvis_from_thigh(const LegPose& leg, double outward) {
  return about(Vector3d::UnitX(), outward * leg.hip_abduction) *
         about(Vector3d::UnitY(), -leg.hip_flexion) *
         about(Vector3d::UnitZ(), -outward * leg.hip_rotation);
}

// Sets the five angles of a leg from `first` on. The left leg's adduction and rotation are about
// mirrored axes.
void set_leg(const LegPose& leg, double outward, JointAngle first, JointAngles& out) {
  const Vector3d hip = zxy_angles(pelvis_from_thigh(leg, outward));
  const auto at = static_cast<size_t>(first);
  out[at] = hip[0];
  out[at + 1] = -outward * hip[1];
  out[at + 2] = -outward * hip[2];
  out[at + 3] = leg.knee_flexion;
  out[at + 4] = leg.ankle_dorsiflexion;
}

}  // namespace

JointAngles joint_angles(const Pose& pose) {
  JointAngles out{};
  const Matrix3d pelvis = world_from_pelvis(pose), trunk = world_from_trunk(pose);
  const Vector3d against_ground = zxy_angles(pelvis);
  std::copy(against_ground.begin(), against_ground.end(), out.begin() + kPelvisTilt);
  set_leg(pose.legs[static_cast<size_t>(Side::kRight)], -1, kHipFlexionR, out);
  set_leg(pose.legs[static_cast<size_t>(Side::kLeft)], +1, kHipFlexionL, out);
  const Vector3d lumbar = zxy_angles(pelvis.transpose() * trunk);
  std::copy(lumbar.begin(), lumbar.end(), out.begin() + kLumbarExtension);
  out[kTrunkTilt] = -pose.tilt;
  return out;
}

}  // namespace body
}  // namespace walktrack
