// `walktrack track`: one scene becomes a result folder:
//   joints.csv, uncertainty.csv, the tables of jobs/motion_tables.h, overlay_<camera>.mp4,
//   report.html, run.json
// Frames are streamed; what stays in memory is some kilobytes a frame of results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/job_control.h"
#include "io/config.h"
#include "io/scene.h"

namespace walktrack {

struct TrackJob {
  Scene scene;
  ConfigWithOrigin config;
  std::filesystem::path output;
  bool overwrite = false;
  bool overlay = true;
  std::vector<std::string> command_line;
};

enum class TrackStatus {
  kTracked,
  kNotFound,     // nobody walks in this film
  kBelowGates,   // tracked, but a quality gate of the configuration failed
  kInterrupted,  // told to stop; what was done is kept
  kCutShort,     // a video ended with trouble; what was done is kept
};

struct TrackOutcome {
  TrackStatus status = TrackStatus::kTracked;
  int frames = 0, tracked = 0;
  double frames_per_second = 0;   // of tracking, without the overlay
  std::string trouble;            // for kCutShort and kBelowGates: what happened
  std::filesystem::path look_at;  // the file to open first
};

// Throws UsageError, InputError for what cannot be started.
TrackOutcome track_scene(const TrackJob& job, const JobControl& control);

}  // namespace walktrack
