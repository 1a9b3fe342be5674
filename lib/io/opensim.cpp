#include "io/opensim.h"

#include <fmt/format.h>

#include "body/joint_angles.h"
#include "core/conventions.h"
#include "io/csv.h"
#include "io/motion_file.h"

namespace walktrack {

namespace {

constexpr const char* kAngleColumns =
    "time\tpelvis_tilt\tpelvis_list\tpelvis_rotation\tpelvis_tx\tpelvis_ty\tpelvis_tz\t"
    "hip_flexion_r\thip_adduction_r\thip_rotation_r\tknee_angle_r\tankle_angle_r\t"
    "hip_flexion_l\thip_adduction_l\thip_rotation_l\tknee_angle_l\tankle_angle_l\t"
    "lumbar_extension\tlumbar_bending\tlumbar_rotation";
constexpr int kAngleColumnCount = 20;

std::string angle_row(double time, const Pose& pose) {
  std::string text = csv_number(time);
  const JointAngles angles = joint_angles(pose);
  for (size_t k = 0; k <= kLumbarRotation; ++k) {
    append_number(text, '\t', deg_from_rad(angles[k]));
    if (k != kPelvisRotation) continue;
    for (const double value : opensim_from_world(pose.root)) append_number(text, '\t', value);
  }
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
