// kinetics.csv: the forces of a motion (kinetics/kinetics.h), one row for each frame.
//
//   t, com_{x,y,z}_m,
//   for the left (l_) and the right foot (r_): grf_{x,y,z}_n of the ground on the foot,
//     cop_{x,y,z}_m (empty while it is not loaded), free_moment_nm about the ground's normal,
//   for the left and the right leg: moments hip_flexion_nm, hip_abduction_nm, knee_flexion_nm,
//     ankle_dorsiflexion_nm, powers hip_w, knee_w, ankle_w,
//   kinetic_energy_j, potential_energy_j, unexplained_force_n, unexplained_moment_nm,
// Each column except t is followed by its 5-95 % band, <column>_p05 and _p95: the value -/+ 1.645
// standard deviations over the members, empty without members; the band of a loaded foot's vertical
// force includes the model's error, if one is given. Vectors are in the calibration's world axes.
// Rows without a known body are empty except for t. Subject, smoothing and totals are in
// tables.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "camera/world_frame.h"
#include "io/tables/table_notes.h"
#include "kinetics/force_error.h"
#include "kinetics/kinetics.h"

namespace walktrack {
inline namespace io {

// Spread of every column of each row over members: mean and sum of squared differences are updated
// with each member (Welford 1962), so that no member is stored.
class KineticsBands {
 public:
  // `load_error`: error of a foot's vertical load in addition to the spread of the members, N.
  explicit KineticsBands(const WorldFrame& world, double load_error = 0)
      : world_(world), load_error_(load_error) {}
  // Adds the kinetics of another motion at the same times.
  void add(const Kinetics& member);
  // Half the band's width in a column of a row, whose frame is `frame`; NaN unless at least two
  // members, and half of those that know the row's body, have a value.
  double half_width(size_t row, size_t column, const KineticsFrame& frame) const;

 private:
  struct Sum {
    double mean = 0, squares = 0;
    int count = 0;
  };
  struct Row {
    int members = 0;
    std::vector<Sum> columns;
  };
  double model_error(size_t column, const KineticsFrame& frame) const;

  WorldFrame world_;
  double load_error_;
  std::vector<Row> rows_;
};

std::string kinetics_csv(const Kinetics& kinetics, const KineticsBands& bands,
                         const WorldFrame& world);

// The same table for simulated forces, of a walk in calibration axes.
std::string simulated_kinetics_csv(const Kinetics& kinetics);

// The notes on "kinetics.csv".
TableNotes kinetics_notes(const Kinetics& kinetics, const Subject& subject,
                          const KineticsConfig& config);
TableNotes simulated_kinetics_notes(const Kinetics& kinetics, const Subject& subject);

// The ground reactions of such a table; rows without them are NaN. InputError for another table.
GroundForces read_ground_forces(const std::filesystem::path& path);

}  // namespace io
}  // namespace walktrack
