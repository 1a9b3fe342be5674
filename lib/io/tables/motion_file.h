// joints.csv: joint centres over time, and uncertainty.csv beside it.
//
//   t,pelvis_x,pelvis_y,pelvis_z,neck_x,…   seconds and metres in the calibration's world axes, one
//   row a frame; an empty cell is unknown (NaN in a Motion). Columns may come in any order, joints
//   may be missing, triples of other names (lheel_x, lheel_y, lheel_z) are passed over.
//   t,<joint>_<axis>_sd,<joint>_<axis>_p05,<joint>_<axis>_p95,…
// Arms are written where any of their joints is known.
#pragma once

#include <filesystem>
#include <string>

#include "body/motion.h"
#include "camera/world_frame.h"
#include "metrics/statistics/coverage.h"

namespace walktrack {
inline namespace io {

// Into the library's world; a TRC or C3D file (marker_file.h) is upright by itself. InputError
// naming line and column for what is no such table: a missing or misspelt column, times that do not
// increase, text for a number.
Motion read_motion(const std::filesystem::path& path, const WorldFrame& world = {});
std::string motion_csv(const Motion& motion, const WorldFrame& world = {});

// Standard deviations and percentiles about the motion's rows (equal times). Exact where
// calibration axes are world axes up to order and sign; for tilted ones, as if the world's axes
// were independent.
std::string uncertainty_csv(const Motion& motion, const JointUncertainty& uncertainty,
                            const WorldFrame& world = {});

// In calibration axes, as written.
JointUncertainty read_uncertainty(const std::filesystem::path& path);

// How many joints a table of this motion lists: with arms only where an arm joint is known.
int listed_joint_count(const Motion& motion);

}  // namespace io
}  // namespace walktrack
