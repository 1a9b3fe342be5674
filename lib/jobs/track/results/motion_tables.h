// The tables that follow from a motion, whether it was tracked or measured: gait.json, gait.csv,
// angles.csv, kinetics.csv with tables.json, for OpenSim joints.trc, angles.mot,
// ground_reaction.mot and joint_moments.sto, for laboratories joints.c3d, and the moving figure,
// figure.bvh and figure.glb.
#pragma once

#include <string>
#include <vector>

#include "camera/world_frame.h"
#include "io/archive/result_folder.h"
#include "io/tables/angles_file.h"
#include "jobs/track/report/walk_summary.h"
#include "kinetics/kinetics.h"
#include "metrics/gait_error.h"

namespace walktrack {
inline namespace jobs {

struct AnalysedMotion {
  Motion motion;
  Ensemble members;  // as likely ones, for the bands; may be none
  std::vector<SupportTransfer> transfers;
  std::vector<AngleRow> angles;  // one for each row
  double rate = 30;              // Hz
  Subject subject;
  Eigen::Vector3d gravity{0, 0, -9.80665};  // m/s^2
  WorldFrame world;                         // of the tables
  FigureError figure_error;  // with model_error: the errors of gait beyond the members
  double model_error = 0;
};

// All files that the tables may be.
std::vector<std::string> motion_table_files();

// What the tables come to.
struct TableTotals {
  KineticsTotals forces;
  WalkSummary walk;
};

// Writes the tables.
TableTotals write_motion_tables(const AnalysedMotion& analysed, const KineticsConfig& config,
                                const ResultFolder& folder);

}  // namespace jobs
}  // namespace walktrack
