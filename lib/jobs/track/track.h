// `walktrack track`: one scene becomes a result folder:
//   joints.csv, uncertainty.csv, the tables of jobs/track/results/motion_tables.h,
//   overlay_<camera>.mp4, report.html, run.json
// Frames are streamed and their records kept in a file (io/archive/frame_file.h): what grows in
// memory with the video is what the tables are made of, some kilobytes a frame, at the end.
//
// Before it begins it looks at the scene as `check` does (jobs/check/check.h): what is wrong stops
// it, what is worth knowing goes into run.json and the report.
//
// While it works the folder also holds checkpoint.bin and frames.bin, from which another process
// can go on after this one was killed or told to stop: it ends with the same bytes. Checkpoints are
// made between frames in which the walker is tracked, not while they are searched for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/job_control.h"
#include "io/config/config.h"
#include "io/scene/scene.h"
#include "jobs/check/check.h"
#include "jobs/track/report/walk_summary.h"

namespace walktrack {
inline namespace jobs {

struct TrackJob {
  Scene scene;
  ConfigWithOrigin config;
  std::filesystem::path output;
  bool overwrite = false;  // a complete result, and a checkpoint that is not gone on from
  bool resume = false;     // go on from the folder's checkpoint, if there is one
  bool overlay = true;
  bool ignore_checks = false;  // go on though the scene's checks fail, and say so
  std::vector<std::string> command_line;
};

enum class TrackStatus {
  kTracked,
  kNotFound,       // nobody walks in this video
  kQualityFailed,  // tracked, but a quality check failed
  kInterrupted,    // told to stop; what was done is kept
  kCutShort,       // a video ended with trouble; what was done is kept
};

struct TrackOutcome {
  TrackStatus status = TrackStatus::kTracked;
  int frames = 0, tracked = 0;
  double frames_per_second = 0;  // of the whole command, until the report is written
  std::optional<double> stride_frames_per_second;  // see TrackRun
  bool resumable = false;  // for kInterrupted: there is a checkpoint to go on from
  WalkSummary walk;
  std::vector<QualityMeasure> failed_checks;  // for kQualityFailed
  std::vector<std::string> checks;            // what the scene's checks found
  std::optional<FoundLag> lag;                // between two cameras, taken out
  std::string message;                        // for kCutShort and kQualityFailed: what happened
  std::filesystem::path open_first;           // the file to open first
};

// As run.json has it.
std::string_view status_word(TrackStatus status);

// Throws UsageError, InputError for what cannot be started, also for a checkpoint that does not fit
// and for a scene whose checks fail.
TrackOutcome track_scene(const TrackJob& job, const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
