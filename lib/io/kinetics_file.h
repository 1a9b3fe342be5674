// kinetics.csv: the forces behind a motion (kinetics/kinetics.h), one row a frame.
//
// Comment lines that start with '#' say rate, axes, subject, smoothing and totals. Then
//   t, com_{x,y,z}_m,
//   for the left (l_) and the right foot (r_): grf_{x,y,z}_n of the ground on the foot,
//     cop_{x,y,z}_m (empty while it is not loaded), free_moment_nm about the ground's normal,
//   for the left and the right leg: moments hip_flexion_nm, hip_abduction_nm, knee_flexion_nm,
//     ankle_dorsiflexion_nm, powers hip_w, knee_w, ankle_w,
//   kinetic_energy_j, potential_energy_j, unexplained_force_n, unexplained_moment_nm,
// each but t followed by its 5-95 % band, <column>_p05 and _p95: the value -/+ 1.645 standard
// deviations over the members, empty without members. Vectors are in the calibration's world axes.
// Rows without a known body are empty but for t.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "camera/world_frame.h"
#include "kinetics/force_error.h"
#include "kinetics/kinetics.h"

namespace walktrack {

// `members`: the kinetics of other motions over the same times.
std::string kinetics_csv(const Kinetics& kinetics, std::span<const Kinetics> members,
                         const Subject& subject, const KineticsConfig& config,
                         const WorldFrame& world);

// The same table for forces that are known, of a walk in calibration axes.
std::string simulated_kinetics_csv(const Kinetics& kinetics, const Subject& subject);

// The ground reactions of such a table; rows without them are NaN. InputError for another table.
GroundForces read_ground_forces(const std::filesystem::path& path);

}  // namespace walktrack
