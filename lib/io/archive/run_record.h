// run.json: how a result came about and what happened on the way.
//
// Everything but the "timing" block follows from the inputs, the configuration and the seed alone,
// so it is the same for any number of threads; threads, command line and clock times are in that
// block.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/archive/origin.h"
#include "io/config/config.h"

namespace walktrack {
inline namespace io {

// One measure of a result's quality, with the limit that it has to keep, if any.
struct QualityMeasure {
  std::string name;     // e.g. "foot_slide_mm"
  std::string what;     // the same in words
  std::string meaning;  // what it says, a sentence
  std::string advice;   // what to do when it misses its limit
  double value = 0;
  std::string unit;  // "" = a number
  int digits = 0;    // after the point, where people read it
  std::optional<double> limit;
  bool at_most = true;  // or at least
  bool passed() const { return !limit || (at_most ? value <= *limit : value >= *limit); }
};

using RunNumbers = std::vector<std::pair<std::string, double>>;
using RunSeries = std::vector<std::pair<std::string, std::vector<double>>>;

struct RunRecord {
  std::string command;             // e.g. "track"
  std::string scene;               // name of the scene file
  std::string scene_digest;        // SHA-256 of it
  Origin inputs;                   // the files that a track has read, by name, with their digests
  ConfigWithOrigin config;         // effective
  std::string status;              // e.g. "tracked", "lost", "interrupted"
  std::vector<std::string> notes;  // what the user should know
  RunNumbers numbers;              // e.g. "fallen_particles"
  std::vector<QualityMeasure> quality;
  RunSeries by_frame;  // e.g. "ess"; NaN -> null
  std::string digest;  // result_digest() of the result's tables

  // The timing block.
  std::vector<std::string> command_line;
  int threads = 1;  // in fact used
  // In order of the stages: passed on the clock, and worked by all threads together.
  std::vector<std::pair<std::string, double>> stage_seconds, stage_cpu_seconds;
  double seconds = 0;                 // altogether
  std::optional<double> cpu_seconds;  // of all threads, user and system
  // Of the whole command; and of the frames in which somebody who was found is followed, without
  // start and output. Only where there are frames to follow.
  std::optional<double> frames_per_second, stride_frames_per_second;
  int resumed_at_frame = 0;  // that these times begin with
};

std::string run_json(const RunRecord& record);

// What such a text says that the result depends on; of what is no such text, nothing.
Origin origin_in(const std::string& run_json);

// The command that wrote the result folder ("track", …); nullopt where there is none.
std::optional<std::string> command_of_result(const std::filesystem::path& folder);

// SHA-256 of joints.csv and uncertainty.csv, one after the other.
std::string result_digest(const std::string& joints_csv, const std::string& uncertainty_csv);

}  // namespace io
}  // namespace walktrack
