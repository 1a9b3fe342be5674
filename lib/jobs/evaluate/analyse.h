// `walktrack analyse`: gait, joint angles and forces of an existing motion (motion capture, another
// tracker, an edited joints.csv) as a result folder: the tables of
// jobs/track/results/motion_tables.h, report.html, run.json. Without particles there are no bands.
// If a run.json beside the motion's file states that the motion was tracked, its forces are
// smoothed in the same way as by `track`.
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
  std::optional<double> height;  // m; otherwise estimated from the lengths of thighs and shanks
  std::optional<double> mass;    // kg; otherwise that of the default subject
  ConfigWithOrigin config;
  bool overwrite = false;
  std::vector<std::string> command_line;
};

struct AnalyseOutcome {
  size_t steps = 0;
  double speed = 0;                  // m/s
  std::filesystem::path open_first;  // the file to open first
};

// InputError if the file is not a motion, UsageError for an output that may not be overwritten.
AnalyseOutcome analyse(const AnalyseJob& job);

}  // namespace jobs
}  // namespace walktrack
