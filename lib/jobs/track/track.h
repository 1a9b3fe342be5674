// `walktrack track`: tracks the subject of a scene and writes a result folder:
//   joints.csv, uncertainty.csv, the tables of jobs/track/results/motion_tables.h,
//   overlay_<camera>.mp4, report.html, run.json
// Frames are streamed and their records are kept in a file (io/archive/frame_file.h). Only the
// content of the tables grows in memory with the video, some kilobytes for each frame.
//
// First the scene is checked as by `check` (jobs/check/check.h): failures stop the command; remarks
// are recorded in run.json and in the report.
//
// During the work the folder also contains checkpoint.bin and frames.bin, from which another
// process can continue to the same bytes after this one was killed or interrupted. Checkpoints are
// written between frames in which the subject is tracked, not during a search.
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
  bool overwrite = false;  // replaces a complete result, and a checkpoint from which it does not
                           // resume
  bool resume = false;     // resumes from the folder's checkpoint if there is one
  bool overlay = true;
  bool ignore_checks = false;  // continues if the scene's checks fail, and reports it
  std::vector<std::string> command_line;
};

enum class TrackStatus {
  kTracked,
  kNotFound,       // nobody walks in this video
  kQualityFailed,  // tracked, but a quality check failed
  kInterrupted,    // the part that was done is kept
  kCutShort,       // a video ended with an error; the part that was done is kept
};

struct TrackOutcome {
  TrackStatus status = TrackStatus::kTracked;
  int frames = 0, tracked = 0;
  double frames_per_second = 0;  // of the whole command, until the report is written
  std::optional<double> stride_frames_per_second;  // see TrackRun
  bool resumable = false;  // for kInterrupted: there is a checkpoint to resume from
  WalkSummary walk;
  std::vector<QualityMeasure> failed_checks;  // for kQualityFailed
  std::vector<std::string> checks;            // findings of the scene's checks
  std::optional<FoundLag> lag;                // between two cameras, which was corrected
  std::string message;                        // for kCutShort and kQualityFailed: the reason
  std::filesystem::path open_first;           // the file to open first
};

// The word in run.json.
std::string_view status_word(TrackStatus status);

// Throws UsageError or InputError for what cannot be started, also for a checkpoint that does not
// fit and for a scene whose checks fail.
TrackOutcome track_scene(const TrackJob& job, const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
