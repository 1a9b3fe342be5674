// `walktrack optimise`: the motion of another tracker or of motion capture becomes one of a body of
// constant lengths that fits the floor, people's accelerations and, with a scene, the images: the
// estimate that `track` makes of its own track (tracker/smooth/trajectory.h), with the given joints
// in the place of the particles. Soles that lie flat do not move, and no toe is in the ground.
//
// The result folder is that of `track`, and says what has changed: feet that slide or sink in,
// jitter, and torques and ground forces before and after.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/job_control.h"
#include "jobs/optimise/plausible.h"
#include "jobs/track/track.h"

namespace walktrack {
inline namespace jobs {

struct OptimiseJob {
  std::filesystem::path motion;  // joints.csv, .trc, .c3d, or a folder with a joints.csv
  // Its videos begin at the motion's time 0.
  std::optional<Scene> scene;
  std::optional<double> height;  // m; otherwise the scene's, or estimated from thighs and shanks
  std::optional<double> mass;    // kg; otherwise the scene's or the default subject's
  double joint_sd = 0.02;        // m, of the given joints
  std::filesystem::path output;
  ConfigWithOrigin config;
  bool overwrite = false;
  bool overlay = true;
  bool ignore_checks = false;
  std::vector<std::string> command_line;
};

struct OptimiseOutcome {
  std::vector<Change> changes;
  double moved = 0;         // mean displacement of the scored joints, m
  double floor_height = 0;  // of the given motion, m; it has been lowered by that
  size_t replaced = 0;      // given joints that were far off (outliers.h)
  size_t frames = 0, used = 0;
  bool interrupted = false;          // then nothing is written
  std::filesystem::path open_first;  // the file to open first
};

// InputError for a motion that cannot be read, that has no frame with hips, knees and ankles, or
// that shares no frame with the videos; UsageError as by `track`.
OptimiseOutcome optimise(const OptimiseJob& job, const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
