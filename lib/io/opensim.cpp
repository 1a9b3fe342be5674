#include "io/opensim.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/conventions.h"
#include "io/csv.h"
#include "io/motion_file.h"

namespace walktrack {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d opensim_from_world(const Vector3d& point) { return {point.x(), point.z(), -point.y()}; }

// A rotation between body frames, both turned from (forward, left, up) to (forward, up, right).
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
Vector3d zxy_angles(const Matrix3d& r) {
  return {std::atan2(-r(0, 1), r(1, 1)), std::asin(std::clamp(r(2, 1), -1.0, 1.0)),
          std::atan2(-r(2, 0), r(2, 2))};
}

Matrix3d about(const Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

// As in body/pose.h.
Matrix3d world_from_pelvis(const Pose& pose) {
  return about(Vector3d::UnitZ(), pose.heading) * about(Vector3d::UnitX(), pose.list) *
         about(Vector3d::UnitY(), pose.tilt);
}

Matrix3d world_from_trunk(const Pose& pose) {
  return about(Vector3d::UnitZ(), pose.heading) * about(Vector3d::UnitY(), pose.tilt);
}

Matrix3d pelvis_from_thigh(const LegPose& leg, double outward) {
  return about(Vector3d::UnitX(), outward * leg.hip_abduction) *
         about(Vector3d::UnitY(), -leg.hip_flexion) *
         about(Vector3d::UnitZ(), -outward * leg.hip_rotation);
}

constexpr const char* kAngleColumns =
    "time\tpelvis_tilt\tpelvis_list\tpelvis_rotation\tpelvis_tx\tpelvis_ty\tpelvis_tz\t"
    "hip_flexion_r\thip_adduction_r\thip_rotation_r\tknee_angle_r\tankle_angle_r\t"
    "hip_flexion_l\thip_adduction_l\thip_rotation_l\tknee_angle_l\tankle_angle_l\t"
    "lumbar_extension\tlumbar_bending\tlumbar_rotation";
constexpr int kAngleColumnCount = 20;

void append_degrees(std::string& text, double angle) {
  append_number(text, '\t', deg_from_rad(angle));
}

void append_leg(std::string& text, const LegPose& leg, double outward) {
  // The left leg's adduction and rotation turn about mirrored axes.
  const Vector3d hip = zxy_angles(opensim_rotation(pelvis_from_thigh(leg, outward)));
  append_degrees(text, hip[0]);
  append_degrees(text, -outward * hip[1]);
  append_degrees(text, -outward * hip[2]);
  append_degrees(text, leg.knee_flexion);
  append_degrees(text, leg.ankle_dorsiflexion);
}

std::string angle_row(double time, const Pose& pose) {
  std::string text = csv_number(time);
  const Matrix3d pelvis = world_from_pelvis(pose);
  for (const double angle : zxy_angles(opensim_rotation(pelvis))) append_degrees(text, angle);
  for (const double value : opensim_from_world(pose.root)) append_number(text, '\t', value);
  append_leg(text, pose.legs[static_cast<size_t>(Side::kRight)], -1);
  append_leg(text, pose.legs[static_cast<size_t>(Side::kLeft)], +1);
  const Matrix3d lumbar = pelvis.transpose() * world_from_trunk(pose);
  for (const double angle : zxy_angles(opensim_rotation(lumbar))) append_degrees(text, angle);
  return text + "\n";
}

}  // namespace

std::string trc_from_motion(const Motion& motion, double rate, const std::string& name) {
  const auto joints = static_cast<size_t>(listed_joint_count(motion));
  const size_t frames = motion.time.size();
  std::string text = fmt::format(
      "PathFileType\t4\t(X/Y/Z)\t{}\n"
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
      "OrigNumFrames\n{:g}\t{:g}\t{}\t{}\tm\t{:g}\t1\t{}\nFrame#\tTime",
      name, rate, rate, frames, joints, rate, frames);
  std::string axes = "\t";
  for (size_t joint = 0; joint < joints; ++joint) {
    text += fmt::format("\t{}\t\t", kJointNames[joint]);
    axes += fmt::format("\tX{0}\tY{0}\tZ{0}", joint + 1);
  }
  text += "\n" + axes + "\n\n";
  for (size_t i = 0; i < frames; ++i) {
    text += fmt::format("{}\t{}", i + 1, csv_number(motion.time[i]));
    for (size_t joint = 0; joint < joints; ++joint) {
      for (const double value : opensim_from_world(motion.joints[i].at[joint])) {
        append_number(text, '\t', value);
      }
    }
    text += "\n";
  }
  return text;
}

std::string mot_from_poses(std::span<const double> times, std::span<const Pose> poses,
                           const std::string& name) {
  std::string text = fmt::format(
      "{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees=yes\n\n"
      "Units are S.I. units (second, meters), angles are in degrees.\n"
      "Ground: x and z (right) level, y up. pelvis_tx, ty, tz: midpoint of the hip centres.\n"
      "Positive: pelvis_tilt backwards, pelvis_list right side down, pelvis_rotation to the left,\n"
      "hip flexion, adduction, toes inwards; knee flexion; ankle dorsiflexion.\n"
      "endheader\n{}\n",
      name, times.size(), kAngleColumnCount, kAngleColumns);
  for (size_t i = 0; i < times.size(); ++i) text += angle_row(times[i], poses[i]);
  return text;
}

}  // namespace walktrack
