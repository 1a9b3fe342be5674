// `walktrack analyse`: gait, joint angles and forces of a motion that is already there (motion
// capture, another tracker, an edited joints.csv) as a result folder: the tables of
// jobs/track/results/motion_tables.h, report.html, run.json. Without particles there are no bands.
// If a run.json beside the motion's file says that the motion was tracked, its forces are smoothed
// as `track` smooths them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/config/config.h"

namespace walktrack {
inline namespace jobs {

struct AnalyseJob {
  std::filesystem::path motion;  // joints.csv, z up and the ground at z = 0, or a folder with one
  std::filesystem::path output;
  std::optional<double> height;  // m; otherwise the one that thighs and shanks belong to
  std::optional<double> mass;    // kg; otherwise the default subject's
  ConfigWithOrigin config;
  bool overwrite = false;
  std::vector<std::string> command_line;
};

struct AnalyseOutcome {
  size_t steps = 0;
  double speed = 0;                  // m/s
  std::filesystem::path open_first;  // the file to open first
};

// InputError for what is no motion, UsageError for an output that may not be overwritten.
AnalyseOutcome analyse(const AnalyseJob& job);

}  // namespace jobs
}  // namespace walktrack
