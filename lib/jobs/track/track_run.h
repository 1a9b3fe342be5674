// Tracks one scene frame by frame: observers, tracker, the records so far, and the checkpoints from
// which another process can resume.
//
// The next frame is decoded and segmented in parallel with the particles of this one. The search
// region of a frame is therefore determined from the frame before the previous one; if the subject
// has just been lost, it is the whole image.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "io/archive/checkpoint_file.h"
#include "io/archive/result_folder.h"
#include "jobs/track/input/movement.h"
#include "jobs/track/input/next_frame.h"
#include "jobs/track/particle_budget.h"
#include "jobs/track/results/track_results.h"
#include "jobs/track/stopwatch.h"
#include "jobs/track/track.h"
#include "jobs/track/track_setup.h"
#include "tracker/smooth/leg_labels.h"

namespace walktrack {
inline namespace jobs {

// The files of unfinished work in a result folder.
inline constexpr std::string_view kCheckpointFile = "checkpoint.bin", kFramesFile = "frames.bin";
inline constexpr std::string_view kSmoothedFile = "smoothed_frames.bin",
                                  kStandingFile = "standing_frames.bin",
                                  kNamedFile = "named_frames.bin",
                                  kPlantedFile = "planted_frames.bin";
// The files from which a run is resumed, which only exist during the work.
inline constexpr std::array kFilesOfWork{kCheckpointFile, kFramesFile};
inline constexpr std::array kPassingFiles{kCheckpointFile, kFramesFile,   kNamedFile,
                                          kSmoothedFile,   kStandingFile, kPlantedFile};

// Decides when a checkpoint is worth its time.
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
  // Begins with the first frame or, in a folder that has kept kFilesOfWork, after the checkpoint.
  TrackRun(const TrackJob& job, SceneVideo& video, const ResultFolder& folder, Origin origin,
           std::optional<Checkpoint> checkpoint, const JobControl& control);

  // Skips the frames before the checkpoint. InputError if the video ends there.
  void skip(const JobControl& control);
  // Processes the next frame: evidence, tracking, updates of the appearance, and a checkpoint if
  // one is due. Returns false if there is none.
  bool step();
  // Whether another process could resume here, except while nobody is tracked; this comes
  // within a second or two.
  bool may_stop() const { return !tracker_.tracking() || has_state(); }
  // To be called after the last frame. `resumable`: another process may resume here. Returns
  // whether it could.
  bool finish(bool resumable);

  int first_frame() const { return static_cast<int>(first_frame_); }
  int frames_read() const { return static_cast<int>(frames_read_); }
  int losses() const { return tracker_.losses(); }
  int frames_beside_others() const { return tracker_.frames_beside_others(); }
  SubjectEstimates estimates() const { return tracker_.estimates(); }
  const BodyModel& model() const { return tracker_.model(); }
  bool keypoints_lead() const { return tracker_.keypoints_lead(); }
  int threads() const { return threads_; }
  // Reads the video again if nobody was found, and returns the reason (why_nobody.h).
  std::string why_nobody(const JobControl& control);
  const TrackedFrames& frames() const { return frames_; }
  // By camera.
  std::vector<KeypointTerm::State> keypoints() const;
  // Irregularities of keypoint files, one sentence each.
  std::vector<std::string> notes() const;
  // By frame, NaN if not tracking; empty without a time budget.
  const std::vector<double>& particles_used() const { return particles_used_; }
  // Speed over the frames before and after which the subject was tracked; nullopt if there are
  // none.
  std::optional<double> stride_frames_per_second() const {
    return stride_.frames > 0 ? std::optional(stride_.frames / stride_.seconds) : std::nullopt;
  }
  Stopwatch& watch() { return watch_; }
  const Stopwatch& watch() const { return watch_; }

 private:
  // Whether a checkpoint can be written. The frame after a start has been prepared as one of the
  // search; a run that is resumed there would prepare it as one of the track.
  bool has_state() const { return tracker_.has_state() && prepared_for_track_; }
  Region region(size_t camera) const;
  std::vector<Region> regions() const;
  // Several cameras share the threads.
  int row_threads() const { return setup_.observers.size() == 1 ? threads_ : 1; }
  void fetch();
  void complete();
  void push();
  void keep(std::vector<FrameRecord> records);
  bool in_doubt_only() const;
  void hear_names(const FrameRecord& record);
  void watch_movement();
  void follow();
  void learn();
  void pace(const TimePoint& since);
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
  NamesSoFar names_;  // only used if the network runs on doubtful frames alone
  std::vector<Region> everywhere_;
  std::optional<MovementWatch> movement_;
  bool left_ = false;          // the newest record's figure is out of the picture
  std::deque<double> moving_;  // of the frames whose records are not finished
  SceneVideo& video_;
  NextFrame next_;
  bool prepared_for_track_ = true;  // the next frame
  // Of the next frame; they are part of checkpoints.
  std::vector<Region> regions_;
  SceneEvidence evidence_;
  TrackedFrames frames_;
  uint64_t first_frame_, frames_read_;  // of the video
  CheckpointTimer timer_;
  double filter_seconds_ = 0;  // of the newest frame
  struct {
    int frames = 0;
    double seconds = 0;
  } stride_;
  std::vector<double> particles_used_;
};

}  // namespace jobs
}  // namespace walktrack
