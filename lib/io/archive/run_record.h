// run.json: how a result was computed, and statistics of the computation.
//
// Everything except the "timing" block follows from the inputs, the configuration and the seed
// alone, and is the same for any number of threads. The number of threads, the command line and
// times are in that block.
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

// A measure of a result's quality, with its limit if there is one.
struct QualityMeasure {
  std::string name;     // e.g. "foot_slide_mm"
  std::string what;     // its description
  std::string meaning;  // what it measures, a sentence
  std::string advice;   // advice if it violates its limit
  double value = 0;
  std::string unit;  // "" = a number
  int digits = 0;    // decimals in text
  std::optional<double> limit;
  bool at_most = true;  // or at least
  bool passed() const { return !limit || (at_most ? value <= *limit : value >= *limit); }
};

// What was estimated for the whole recording.
struct RecordingConstant {
  std::string name;  // e.g. "height_m"
  std::string what;  // its description
  double value, sd;
  std::string unit;
  int digits;          // decimals in text
  std::string effect;  // what it did to the result, one or two sentences
};

using RunNumbers = std::vector<std::pair<std::string, double>>;
using RunSeries = std::vector<std::pair<std::string, std::vector<double>>>;

struct RunRecord {
  std::string command;             // e.g. "track"
  std::string scene;               // name of the scene file
  std::string scene_digest;        // SHA-256 of that file
  Origin inputs;                   // input files of a track by name, with their digests
  ConfigWithOrigin config;         // effective configuration
  std::string status;              // e.g. "tracked", "lost", "interrupted"
  std::vector<std::string> notes;  // notes for the user
  RunNumbers numbers;              // e.g. "fallen_particles"
  std::vector<RecordingConstant> constants;
  std::vector<QualityMeasure> quality;
  RunSeries by_frame;  // e.g. "ess"; NaN -> null
  std::string digest;  // result_digest() of the result's tables

  // The timing block.
  std::vector<std::string> command_line;
  int threads = 1;  // the number that was used
  // In the order of the stages: elapsed time, and CPU time of all threads together.
  std::vector<std::pair<std::string, double>> stage_seconds, stage_cpu_seconds;
  double seconds = 0;                 // altogether
  std::optional<double> cpu_seconds;  // of all threads, user and system
  // Speed of the whole command, and of the frames in which the subject is followed, without start
  // and output. Only if frames are tracked.
  std::optional<double> frames_per_second, stride_frames_per_second;
  int resumed_at_frame = 0;  // the first frame that these times include
};

std::string run_json(const RunRecord& record);

// The origin that such a text states; empty for any other text.
Origin origin_in(const std::string& run_json);

// The command that wrote the result folder ("track", …); nullopt if there is none.
std::optional<std::string> command_of_result(const std::filesystem::path& folder);

// SHA-256 of joints.csv followed by uncertainty.csv.
std::string result_digest(const std::string& joints_csv, const std::string& uncertainty_csv);

}  // namespace io
}  // namespace walktrack
