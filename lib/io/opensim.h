// Files for OpenSim and its relatives: marker positions (.trc) and joint angles (.mot).
//
// OpenSim's ground has x forward, y up, z to the right of x; the library's world has x, z up and y
// to the left, so (x, y, z)_opensim = (x, z, -y)_world. Angles are those of body/joint_angles.h,
// which have the names and signs of the Rajagopal and Lai full-body models.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "body/motion.h"
#include "body/pose.h"

namespace walktrack {

// Markers are joint centres, metres, unknown ones blank; `name` is the file's own name, `rate` in
// Hz. Rows must be evenly spaced in time, as motions of one video are.
std::string trc_from_motion(const Motion& motion, double rate, const std::string& name);

// Angles in degrees; pelvis_tx, ty, tz in metres, of the midpoint of the hip centres. Rows without
// a pose are left out.
std::string mot_from_poses(std::span<const double> times, std::span<const Pose> poses,
                           const std::string& name);

}  // namespace walktrack
