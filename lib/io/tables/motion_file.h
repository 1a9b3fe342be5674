// joints.csv: joint centres over time, and uncertainty.csv beside it.
//
//   t,pelvis_x,pelvis_y,pelvis_z,neck_x,…   seconds and metres in the calibration's world axes, one
//   row for each frame; an empty cell is unknown (NaN in a Motion). Columns may have any order,
//   joints may be missing, other groups of three columns (lheel_x, lheel_y, lheel_z) are ignored.
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

// Reads a motion in the library's world; a TRC or C3D file (marker_file.h) is made upright. Throws
// an InputError that names line and column for a missing or misspelt column, times that do not
// increase, or text instead of a number.
Motion read_motion(const std::filesystem::path& path, const WorldFrame& world = {});
std::string motion_csv(const Motion& motion, const WorldFrame& world = {});

// Standard deviations and percentiles of the motion's rows (at the same times). They are exact if
// calibration axes are world axes up to order and sign; for other rotations the errors along the
// world's axes are taken to be independent.
std::string uncertainty_csv(const Motion& motion, const JointUncertainty& uncertainty,
                            const WorldFrame& world = {});

// In calibration axes, as they are written.
JointUncertainty read_uncertainty(const std::filesystem::path& path);

// Number of joints in a table of this motion: arms are included only if one of their joints is
// known.
int listed_joint_count(const Motion& motion);

}  // namespace io
}  // namespace walktrack
