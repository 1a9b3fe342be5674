// One scene being tracked, frame by frame: observers, tracker, the records so far, and the
// checkpoints from which another process could go on.
#pragma once

#include <array>
#include <chrono>
#include <ctime>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/checkpoint_file.h"
#include "io/result_folder.h"
#include "io/scene_video.h"
#include "jobs/particle_budget.h"
#include "jobs/track.h"
#include "jobs/track_results.h"
#include "jobs/track_setup.h"

namespace walktrack {

// The files of unfinished work in a result folder.
inline constexpr std::string_view kCheckpointFile = "checkpoint.bin", kFramesFile = "frames.bin";
inline constexpr std::string_view kSmoothedFile = "smoothed_frames.bin";
inline constexpr std::array kFilesOfWork{kCheckpointFile, kFramesFile};

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start);

// A point in time, and of the work of all threads.
struct Moment {
  Clock::time_point clock = Clock::now();
  std::clock_t cpu = std::clock();
};

// Seconds by stage, in the order of first use: passed on the clock, and worked by all threads.
class Stopwatch {
 public:
  using Stages = std::vector<std::pair<std::string, double>>;
  // Returns the seconds passed.
  double add(std::string_view stage, const Moment& since);
  const Stages& stages() const { return stages_; }
  const Stages& cpu_stages() const { return cpu_stages_; }

 private:
  Stages stages_, cpu_stages_;
};

// When a checkpoint is worth its time.
class CheckpointTimer {
 public:
  explicit CheckpointTimer(double seconds) : seconds_(seconds) {}
  bool due() const;
  void wrote(Clock::time_point since);

 private:
  double seconds_, cost_ = 0;  // s
  Clock::time_point last_ = Clock::now();
};

class TrackRun {
 public:
  // From the first frame or, in a folder that has kept kFilesOfWork, from the checkpoint.
  TrackRun(const TrackJob& job, double frame_rate, const ResultFolder& folder, Origin origin,
           std::optional<Checkpoint> checkpoint, const JobControl& control);

  // Takes the frames that came before the checkpoint from the video. InputError if it ends there.
  void skip(SceneVideo& video, const JobControl& control) const;
  // The next frame, `since` it began to be decoded: evidence, tracking, learning, and a checkpoint
  // if one is due.
  void step(const SceneFrames& images, const Moment& since);
  // After the last frame. `resumable`: another process may go on here; false if it could not.
  bool finish(bool resumable);

  int first_frame() const { return static_cast<int>(first_frame_); }
  int frames_read() const { return static_cast<int>(frames_read_); }
  int losses() const { return tracker_.losses(); }
  std::optional<Stature> stature() const { return tracker_.stature(); }
  int threads() const { return threads_; }
  const TrackedFrames& frames() const { return frames_; }
  // By frame, NaN while not tracking; empty without a budget.
  const std::vector<double>& particles_used() const { return particles_used_; }
  Stopwatch& watch() { return watch_; }
  const Stopwatch& watch() const { return watch_; }

 private:
  Region region(size_t camera) const;
  void observe(const SceneFrames& images);
  void follow();
  void learn();
  void pace(const Moment& since);
  void write_checkpoint();

  const TrackJob& job_;
  std::filesystem::path checkpoint_file_;
  Origin origin_;
  int threads_;
  Stopwatch watch_;
  TrackSetup setup_;
  GaitPrior prior_;
  ParticleBudget budget_;
  Tracker tracker_;
  std::vector<Region> everywhere_;
  SceneEvidence evidence_;
  TrackedFrames frames_;
  uint64_t first_frame_, frames_read_;  // of the film
  CheckpointTimer timer_;
  double filter_seconds_ = 0;  // of the newest frame
  std::vector<double> particles_used_;
};

}  // namespace walktrack
