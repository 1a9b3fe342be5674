// The results of a sweep and its files: sweep.csv, sweep.json, sweep.md and sweep.svg.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/archive/result_folder.h"
#include "jobs/sweep/sweep_grid.h"

namespace walktrack {
inline namespace jobs {

struct SweepJob {
  Scene scene;
  ConfigWithOrigin config;
  std::vector<SweptParameter> parameters;
  int seeds = 3;                // of each setting, from the configuration's on
  int repeats = 1;              // of each run, for its time alone
  std::filesystem::path truth;  // empty = the scene's; without one see SweepReport::reference
  std::filesystem::path output;
  bool again = false;  // repeat complete runs
};

struct SweepRun {
  uint64_t seed = 0;
  bool found = false;                                          // whether the subject was found
  double error_mm = std::numeric_limits<double>::quiet_NaN();  // NaN = not found
  double lost_share = 1;                                       // of the frames after the subject
                                                               // was found
  // Medians of the repeats; CPU time, which other programs hardly affect.
  double seconds_per_frame = std::numeric_limits<double>::quiet_NaN();
  double cpu_seconds_per_frame = std::numeric_limits<double>::quiet_NaN();
};

struct SweepRow {
  SweepSetting setting;
  std::vector<SweepRun> runs;
  // Means over the runs; standard deviation of the error over seeds, NaN for fewer than two.
  double error_mm = 0, error_sd_mm = 0, lost_share = 0;
  double seconds_per_frame = 0, cpu_seconds_per_frame = 0;  // medians of the runs
  bool holds = false;     // every seed found the subject and kept the limit of lost frames
  bool on_front = false;  // no other setting that holds is both faster and more accurate

  double frames_per_second() const { return 1 / seconds_per_frame; }
};

struct SweepReport {
  std::string scene;
  std::vector<SweptParameter> parameters;
  std::vector<SweepRow> rows;  // in grid order, without settings for which no run has finished
  std::string error_is;        // the definition of the error, e.g. "joint error (7 joints), mean,
                               // mm"
  // The reference of the errors: the truth's file or, without one, a run of the richest setting
  // with another seed, so that errors include the error of that run.
  std::string reference;
  bool against_truth = true;
  int seeds = 0, threads = 0;
  bool interrupted = false;
};

// Requirements for a setting.
struct SweepWish {
  std::optional<double> frames_per_second, error_mm;
};

// Which settings to use, one sentence each.
std::vector<std::string> sweep_advice(const SweepReport& report, const SweepWish& wish);

std::string sweep_csv(const SweepReport& report);
std::string sweep_json(const SweepReport& report, const std::vector<std::string>& advice);
std::string sweep_markdown(const SweepReport& report, const std::vector<std::string>& advice);
// The four files and their folder.
Outputs sweep_outputs(const SweepJob& job);
void write_sweep(const SweepReport& report, const std::vector<std::string>& advice,
                 const SweepJob& job);

}  // namespace jobs
}  // namespace walktrack
