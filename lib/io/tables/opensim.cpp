#include "io/tables/opensim.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "body/joint_angles.h"
#include "body/kinematics.h"
#include "core/conventions.h"
#include "io/tables/csv.h"
#include "io/tables/motion_file.h"

namespace walktrack {
inline namespace io {

namespace {

constexpr const char* kAngleColumns =
    "time\tpelvis_tilt\tpelvis_list\tpelvis_rotation\tpelvis_tx\tpelvis_ty\tpelvis_tz\t"
    "hip_flexion_r\thip_adduction_r\thip_rotation_r\tknee_angle_r\tankle_angle_r\t"
    "hip_flexion_l\thip_adduction_l\thip_rotation_l\tknee_angle_l\tankle_angle_l\t"
    "lumbar_extension\tlumbar_bending\tlumbar_rotation";
constexpr int kAngleColumnCount = 20;
constexpr const char* kReactionColumns =
    "time\tground_force_r_vx\tground_force_r_vy\tground_force_r_vz\t"
    "ground_force_r_px\tground_force_r_py\tground_force_r_pz\t"
    "ground_torque_r_x\tground_torque_r_y\tground_torque_r_z\t"
    "ground_force_l_vx\tground_force_l_vy\tground_force_l_vz\t"
    "ground_force_l_px\tground_force_l_py\tground_force_l_pz\t"
    "ground_torque_l_x\tground_torque_l_y\tground_torque_l_z";
constexpr int kReactionColumnCount = 19;
constexpr const char* kMomentColumns =
    "time\thip_flexion_r_moment\thip_adduction_r_moment\tknee_angle_r_moment\t"
    "ankle_angle_r_moment\thip_flexion_l_moment\thip_adduction_l_moment\t"
    "knee_angle_l_moment\tankle_angle_l_moment";
constexpr int kMomentColumnCount = 9;
constexpr std::array kRightThenLeft{Side::kRight, Side::kLeft};

// Rows per second, from the smallest step: the table may have gaps.
double rate_of(std::span<const double> times) {
  double period = std::numeric_limits<double>::infinity();
  for (size_t i = 1; i < times.size(); ++i) period = std::min(period, times[i] - times[i - 1]);
  return 1 / period;
}

// Lines of `notes` must not contain '=', which OpenSim would take for a key.
std::string storage_header(std::string_view name, std::span<const double> times, int columns,
                           bool degrees, std::string_view notes, std::string_view names) {
  return fmt::format(
      "{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees={}\n\n{}\nRows: {:.6g} per second.\n"
      "endheader\n{}\n",
      name, times.size(), columns, degrees ? "yes" : "no", notes, rate_of(times), names);
}

std::vector<double> known_times(const Kinetics& kinetics) {
  std::vector<double> out;
  for (size_t i = 0; i < kinetics.frames.size(); ++i)
    if (kinetics.frames[i].known) out.push_back(kinetics.time[i]);
  return out;
}

// A foot's centre of pressure in every row. Without contact it is the next known one, otherwise the
// last.
std::vector<Eigen::Vector2d> centres_of(const Kinetics& kinetics, Side side) {
  const auto at = [&](size_t i) {
    return kinetics.frames[i].feet[static_cast<size_t>(side)].centre;
  };
  std::vector<Eigen::Vector2d> out(kinetics.frames.size(), Eigen::Vector2d::Zero());
  std::optional<Eigen::Vector2d> last, next;
  for (size_t i = 0; i < out.size(); ++i) {
    if (at(i).allFinite()) last = at(i);
    if (last) out[i] = *last;
  }
  for (size_t i = out.size(); i-- > 0;) {
    if (at(i).allFinite()) next = at(i);
    if (next) out[i] = *next;
  }
  return out;
}

void append_vector(std::string& text, const Eigen::Vector3d& world) {
  for (const double value : opensim_from_world(world)) append_number(text, '\t', value);
}

std::string angle_row(double time, const Pose& pose, const BodyLengths& lengths) {
  std::string text = csv_number(time);
  const JointAngles angles = joint_angles(pose);
  for (size_t k = 0; k <= kLumbarRotation; ++k) {
    append_number(text, '\t', deg_from_rad(angles[k]));
    if (k == kPelvisRotation) append_vector(text, opensim_pelvis(pose, lengths));
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
  text += "\t\n" + axes + "\t\n\n";
  for (size_t i = 0; i < frames; ++i) {
    text += fmt::format("{}\t{}", i + 1, csv_number(motion.time[i]));
    for (size_t joint = 0; joint < joints; ++joint) {
      append_vector(text, motion.joints[i].at[joint]);
    }
    text += "\t\n";
  }
  return text;
}

Eigen::Vector3d opensim_pelvis(const Pose& pose, const BodyLengths& lengths) {
  constexpr double kForward = 0.056276, kUp = 0.078490, kLeg = 0.81;  // m, see the header
  const double scale = (lengths.thigh + lengths.shank) / kLeg;
  return pose.root + scale * (world_from_pelvis(pose) * Eigen::Vector3d(kForward, 0, kUp));
}

std::string mot_from_poses(std::span<const double> times, std::span<const Pose> poses,
                           const BodyLengths& lengths, const std::string& name) {
  std::string text = storage_header(
      name, times, kAngleColumnCount, true,
      "Units are S.I. units (second, meters), angles are in degrees.\n"
      "Ground: x and z (right) level, y up. pelvis_tx, ty, tz: origin of the pelvis in the\n"
      "Rajagopal and Lai models, between the anterior iliac spines.\n"
      "Positive: pelvis_tilt backwards, pelvis_list right side down, pelvis_rotation to the left,\n"
      "hip flexion, adduction, toes inwards; knee flexion; ankle dorsiflexion.",
      kAngleColumns);
  for (size_t i = 0; i < times.size(); ++i) text += angle_row(times[i], poses[i], lengths);
  return text;
}

std::string mot_from_ground_reactions(const Kinetics& kinetics) {
  std::string text = storage_header(
      "ground_reaction", known_times(kinetics), kReactionColumnCount, false,
      "Units are S.I. units (second, meters, Newtons, Newton meters).\n"
      "Ground: x and z (right) level, y up. Computed from the motion, not measured.\n"
      "ground_force: of the ground on the foot, at its centre of pressure (p); r right, l left.",
      kReactionColumns);
  const auto right = centres_of(kinetics, Side::kRight), left = centres_of(kinetics, Side::kLeft);
  for (size_t i = 0; i < kinetics.frames.size(); ++i) {
    if (!kinetics.frames[i].known) continue;
    text += csv_number(kinetics.time[i]);
    for (const Side side : kRightThenLeft) {
      const FootLoad& foot = kinetics.frames[i].feet[static_cast<size_t>(side)];
      const Eigen::Vector2d& centre = (side == Side::kRight ? right : left)[i];
      append_vector(text, foot.force);
      append_vector(text, {centre.x(), centre.y(), 0});
      append_vector(text, {0, 0, foot.free_moment});
    }
    text += "\n";
  }
  return text;
}

std::string sto_from_joint_moments(const Kinetics& kinetics) {
  std::string text =
      storage_header("joint_moments", known_times(kinetics), kMomentColumnCount, false,
                     "Units are S.I. units (second, Newton meters).\n"
                     "Moments of the muscles, by inverse dynamics of the motion. Positive: hip "
                     "flexion, adduction;\n"
                     "knee flexion; ankle dorsiflexion.",
                     kMomentColumns);
  for (size_t i = 0; i < kinetics.frames.size(); ++i) {
    if (!kinetics.frames[i].known) continue;
    text += csv_number(kinetics.time[i]);
    for (const Side side : kRightThenLeft) {
      const LegLoads& leg = kinetics.frames[i].legs[static_cast<size_t>(side)];
      for (const double moment :
           {leg.hip_flexion, -leg.hip_abduction, leg.knee_flexion, leg.ankle_dorsiflexion})
        append_number(text, '\t', moment);
    }
    text += "\n";
  }
  return text;
}

}  // namespace io
}  // namespace walktrack
