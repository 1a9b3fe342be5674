// Files for OpenSim and related programs: marker positions (.trc), joint angles and ground
// reactions (.mot), joint moments (.sto).
//
// OpenSim's ground has x forward, y up, z to the right of x; the library's world has x, z up and y
// to the left, so (x, y, z)_opensim = (x, z, -y)_world. Angles are those of body/joint_angles.h,
// which have the names and signs of the Rajagopal and Lai full-body models.
//
// The origin of those models' pelvis is not the midpoint of the hip centres but that of the
// anterior iliac spines: 56.3 mm in front of it and 78.5 mm above it in the pelvis's axes (hip_r is
// at -.056276, -.078490, .077260; Rajagopal et al., IEEE Trans. Biomed. Eng. 63, 2016), for legs
// that are .81 m long from hip to ankle. Both are scaled with the length of the legs. For two walks
// OpenSim's inverse kinematics places it 81 and 77 mm above; scaling gives 77 and 76.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "body/motion.h"
#include "body/pose.h"
#include "body/subject.h"
#include "kinetics/kinetics.h"

namespace walktrack {
inline namespace io {

// Markers are joint centres in metres, with blank cells if unknown; `name` is the file's own name,
// `rate` is in Hz. Rows must be evenly spaced in time, as they are in motions from one video. The
// last cell of a row is followed by a tab, as in files that OpenSim writes: its reader does not
// accept an empty cell at the end of a line.
std::string trc_from_motion(const Motion& motion, double rate, const std::string& name);

// The position of the pelvis's origin in OpenSim's models, world axes.
Eigen::Vector3d opensim_pelvis(const Pose& pose, const BodyLengths& lengths);

// Angles in degrees; pelvis_tx, ty, tz in metres, from opensim_pelvis(). Rows without a pose are
// left out.
std::string mot_from_poses(std::span<const double> times, std::span<const Pose> poses,
                           const BodyLengths& lengths, const std::string& name);

// Ground reactions as OpenSim's external loads take them, for the right (r) and the left (l) foot:
//   ground_force_r_vx, vy, vz   N, of the ground on the foot
//   ground_force_r_px, py, pz   m, centre of pressure; while nothing presses, where it does next
//                               (else last), so that interpolation does not carry it across the
//                               room
//   ground_torque_r_x, y, z     N m, about the centre of pressure
std::string mot_from_ground_reactions(const Kinetics& kinetics);

// Moments of the muscles, N m, named and signed as OpenSim's inverse dynamics does
// (<coordinate>_moment): hip_flexion, hip_adduction, knee_angle, ankle_angle of either leg.
std::string sto_from_joint_moments(const Kinetics& kinetics);

// Rows in which the body is unknown are left out of both.

}  // namespace io
}  // namespace walktrack
