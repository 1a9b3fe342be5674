// A track that another process resumes ends with the same bytes as one without an interruption.
#include <atomic>
#include <filesystem>
#include <fstream>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "io/archive/checkpoint_file.h"
#include "io/archive/frame_file.h"
#include "jobs/track/track.h"
#include "jobs/track/track_origin.h"
#include "observation/pose_net/pose_net.h"
#include "tests/message_of.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kVideoFrames = 24;

struct Killed {};  // thrown by a test to leave a job in the middle, without cleaning up

class Resume : public testing::Test {
 protected:
  TrackJob job(const std::string& name) const {
    TrackJob job;
    job.scene = read_scene(fs::path(WALKTRACK_SOURCE_DIR) / "data/demo/scene.yaml");
    job.scene.cameras.resize(cameras_);
    // With a given start: six frames later it is tracked.
    job.scene.initial = InitialState{0, {-2.5, 0}, 0, 1.25, {}};
    job.scene.last_frame = video_frames_ - 1;
    job.scene.height_given = size_known_;
    Config& config = job.config.values;
    config.tracker.filter.particles = 40;
    config.tracker.filter.moves = 1;
    config.tracker.start.particles = 10;
    config.tracker.start.seconds = config.tracker.detector.window = 0.2;
    config.observation.person_px = 50;  // small images, for speed
    config.checkpoint.seconds = 0;
    config.tracker.motion.turning_yaw_rate_sd = 0;  // every frame leaves a checkpoint
    config.tracker.start_again = false;             // the same with several cameras
    job.output = folder_.path() / name;
    job.overlay = false;
    if (change_) change_(config);
    return job;
  }
  // Tracks until so many frames are done, and is killed.
  void kill(TrackJob job, size_t frames) const {
    JobControl control;
    control.report = [&](const Progress& progress) {
      if (progress.what == "tracking" && progress.done == frames) throw Killed{};
    };
    EXPECT_THROW(track_scene(job, control), Killed);
  }
  static TrackOutcome resume(TrackJob job) {
    job.resume = true;
    return track_scene(job, {});
  }
  // Every file except the page, which contains the times, and run.json without them.
  std::map<std::string, std::string> result(const std::string& name) const {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_.path() / name)) {
      const std::string file = entry.path().filename().string();
      if (file != "report.html") found[file] = read_file(entry.path());
    }
    Json run = Json::parse(found.at("run.json"));
    run.erase("timing");
    found["run.json"] = run.dump();
    return found;
  }
  int resumed_at(const std::string& name) const {
    return Json::parse(read_file(folder_ / (name + "/run.json")))["timing"]["resumed_at_frame"];
  }
  void expect_same_after_kill(size_t frames) {
    track_scene(job("whole"), {});
    ASSERT_EQ(resumed_at("whole"), 0);
    kill(job("killed"), frames);
    resume(job("killed"));
    EXPECT_GT(resumed_at("killed"), 0);
    EXPECT_EQ(result("killed"), result("whole"));
  }

  TemporaryFolder folder_;
  size_t cameras_ = 1;
  int video_frames_ = kVideoFrames;
  bool size_known_ = true;
  std::function<void(Config&)> change_;
};

// The first frame after a start has been prepared while the subject was searched, in all of the
// image.
TEST_F(Resume, RightAfterAStart) {
  track_scene(job("whole"), {});
  int resumed = 0;
  for (const size_t frames : {size_t{6}, size_t{7}, size_t{8}, size_t{9}}) {
    const std::string name = "killed" + std::to_string(frames);
    kill(job(name), frames);
    resume(job(name));
    EXPECT_EQ(result(name), result("whole")) << frames;
    resumed += resumed_at(name) > 0;
  }
  EXPECT_GE(resumed, 2);
}

TEST_F(Resume, AfterAKillItEndsWithTheSameBytes) {
  cameras_ = 2;
  track_scene(job("whole"), {});
  const auto whole = result("whole");
  EXPECT_FALSE(whole.contains("checkpoint.bin"));
  EXPECT_FALSE(whole.contains("frames.bin"));
  // Before there is a checkpoint, in the middle twice, after the last frame.
  kill(job("killed"), 5);
  for (const size_t frames : {size_t{9}, size_t{16}, size_t{kVideoFrames}}) {
    TrackJob again = job("killed");
    again.resume = true;
    kill(again, frames);
    EXPECT_FALSE(fs::exists(folder_ / "killed/run.json"));
  }
  resume(job("killed"));
  EXPECT_EQ(resumed_at("killed"), kVideoFrames);
  EXPECT_EQ(result("killed"), whole);
}

// Frames that a killed process has written after its last checkpoint are computed again.
TEST_F(Resume, FramesAfterTheCheckpointAreDoneAgain) {
  track_scene(job("whole"), {});
  kill(job("killed"), 12);
  const std::string checkpoint = read_file(folder_ / "killed/checkpoint.bin");
  TrackJob again = job("killed");
  again.resume = true;
  kill(again, 20);
  folder_.write("killed/checkpoint.bin", checkpoint);  // as if none had been due since
  resume(job("killed"));
  EXPECT_EQ(resumed_at("killed"), 12);
  EXPECT_EQ(result("killed"), result("whole"));
}

// While components that turn compete, there is no checkpoint: what has been done since is done
// again, and a run that is interrupted goes on until they are decided, after 1.25 s of the video.
constexpr int kDecided = 6 + 38;  // frames: tracked since the sixth

TEST_F(Resume, WithComponentsThatTurn) {
  video_frames_ = 60;
  change_ = [](Config& config) { config.tracker.motion.turning_yaw_rate_sd = 0.6; };
  track_scene(job("whole"), {});
  kill(job("killed"), 55);
  resume(job("killed"));
  EXPECT_EQ(resumed_at("killed"), kDecided);
  EXPECT_EQ(result("killed"), result("whole"));
}

// Nor while several cameras hold frames back.
TEST_F(Resume, WithFramesThatAreHeld) {
  cameras_ = 2;
  video_frames_ = 60;
  change_ = [](Config& config) { config.tracker.start_again = true; };
  track_scene(job("whole"), {});
  kill(job("killed"), 55);
  resume(job("killed"));
  EXPECT_EQ(resumed_at("killed"), kDecided);
  EXPECT_EQ(result("killed"), result("whole"));
}

TEST_F(Resume, AnInterruptionWaitsUntilComponentsAreDecided) {
  video_frames_ = 60;
  change_ = [](Config& config) { config.tracker.motion.turning_yaw_rate_sd = 0.6; };
  std::atomic<bool> stop{false};
  JobControl control;
  control.stop_request = &stop;
  control.report = [&](const Progress& progress) {
    stop = stop || (progress.what == "tracking" && progress.done == 15);
  };
  const TrackOutcome outcome = track_scene(job("stopped"), control);
  EXPECT_EQ(outcome.status, TrackStatus::kInterrupted);
  EXPECT_TRUE(outcome.resumable);
  resume(job("stopped"));
  EXPECT_EQ(resumed_at("stopped"), kDecided);
}

TEST_F(Resume, WithoutABackground) {
  change_ = [](Config& config) { config.observation.background.enabled = false; };
  expect_same_after_kill(15);
}

TEST_F(Resume, WithFlow) {
  change_ = [](Config& config) { config.observation.flow.enabled = TermSetting::kOn; };
  expect_same_after_kill(15);
}

// Whether left and right are uncertain depends on the frames so far.
TEST_F(Resume, WithANetworkThatIsAskedInDoubtOnly) {
  if (!has_pose_net()) GTEST_SKIP() << "built without OpenCV's dnn module";
  const auto asked = [&](bool in_doubt_only) {
    change_ = [in_doubt_only](Config& config) {
      config.observation.keypoints.enabled = TermSetting::kOn;
      config.observation.keypoints.every = 1;
      config.observation.keypoints.in_doubt_only = in_doubt_only;
    };
  };
  const auto frames = [&] {
    const Json run = Json::parse(result("whole").at("run.json"));
    return run.at("numbers").at("keypoint_frames").get<int>();
  };
  video_frames_ = 40;
  asked(true);
  expect_same_after_kill(18);
  const int in_doubt = frames();
  asked(false);
  TrackJob always = job("whole");
  always.overwrite = true;
  track_scene(always, {});
  EXPECT_GT(in_doubt, 3);
  EXPECT_LT(in_doubt, frames() - 3);
}

// The estimated size is part of the state.
TEST_F(Resume, WithASizeFromTheImages) {
  size_known_ = false;
  change_ = [](Config& config) { config.tracker.detector.window = 0.3; };
  expect_same_after_kill(18);
  EXPECT_TRUE(
      Json::parse(result("whole").at("run.json"))["numbers"].contains("estimated_height_m"));
}

TEST_F(Resume, WithoutColours) {
  change_ = [](Config& config) { config.observation.foreground.enabled = false; };
  expect_same_after_kill(15);
}

TEST_F(Resume, AnInterruptionLeavesACheckpointOfThatFrame) {
  track_scene(job("whole"), {});
  std::atomic<bool> stop{false};
  JobControl control;
  control.stop_request = &stop;
  control.report = [&](const Progress& progress) {
    stop = stop || (progress.what == "tracking" && progress.done == 15);
  };
  TrackJob stopped = job("stopped");
  stopped.config.values.checkpoint.seconds = 1e6;
  const TrackOutcome outcome = track_scene(stopped, control);
  EXPECT_EQ(outcome.status, TrackStatus::kInterrupted);
  EXPECT_TRUE(outcome.resumable);
  EXPECT_TRUE(fs::exists(folder_ / "stopped/run.partial.json"));
  // The search region of frame 15 was chosen in parallel with the particles of frame 14, from the
  // pose in 13.
  const auto found_there = read_checkpoint(folder_ / "stopped/checkpoint.bin",
                                           origin_of_track(stopped.scene, stopped.config))
                               .checkpoint;
  ASSERT_TRUE(found_there);
  EXPECT_EQ(found_there->regions.size(), stopped.scene.cameras.size());
  resume(stopped);
  EXPECT_EQ(resumed_at("stopped"), 15);
  auto found = result("stopped"), whole = result("whole");
  found.erase("run.json");  // it states how often checkpoints were written
  whole.erase("run.json");
  EXPECT_EQ(found, whole);
}

TEST_F(Resume, AnInterruptionBeforeTheFirstFrameIsReportedToo) {
  const std::atomic<bool> stop{true};
  JobControl control;
  control.stop_request = &stop;
  const TrackOutcome outcome = track_scene(job("stopped"), control);
  EXPECT_EQ(outcome.status, TrackStatus::kInterrupted);
  EXPECT_EQ(outcome.frames, 0);
  EXPECT_FALSE(outcome.resumable);
}

// An hour's work is not lost because somebody forgot an option.
TEST_F(Resume, ACheckpointIsNotReplacedWithoutBeingAsked) {
  kill(job("killed"), 12);
  EXPECT_THROW(track_scene(job("killed"), {}), UsageError);
  EXPECT_TRUE(fs::exists(folder_ / "killed/checkpoint.bin"));
  TrackJob anew = job("killed");
  anew.overwrite = true;
  EXPECT_NO_THROW(track_scene(anew, {}));
  EXPECT_EQ(resumed_at("killed"), 0);
}

// One bit of a pose from which the tables are to be made.
TEST_F(Resume, DamagedFramesAreReportedAndTheTrackStartsAnew) {
  track_scene(job("whole"), {});
  kill(job("killed"), 15);
  const std::string file = "killed/frames.bin";
  std::string damaged = read_file(folder_ / file);
  damaged[5] = '\x7f';  // the number of joints in the first record
  folder_.write(file, damaged);
  TrackJob again = job("killed");
  again.resume = true;
  EXPECT_THAT(
      message_of<UsageError>([&] { track_scene(again, {}); }),
      testing::EndsWith("frames.bin: is damaged: a number out of its bounds; -y starts anew"));
  again.overwrite = true;
  std::string said;
  JobControl control;
  control.message = [&](std::string_view text) { said += text; };
  track_scene(again, control);
  EXPECT_THAT(said, testing::HasSubstr("out of its bounds: starting anew"));
  EXPECT_EQ(resumed_at("killed"), 0);
  EXPECT_EQ(result("killed"), result("whole"));
}

TEST_F(Resume, ACheckpointOfSomethingElseIsRefusedOrLeftBehind) {
  kill(job("killed"), 12);
  TrackJob other = job("killed");
  other.config.values.seed = 2;
  try {
    resume(other);
    FAIL() << "another seed";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("with other settings or inputs (seed 1 -> 2); -y starts anew"));
  }
  EXPECT_TRUE(fs::exists(folder_ / "killed/checkpoint.bin"));
  other.config.values.seed = 1;
  other.config.values.threads = 1;  // changes no result
  fs::resize_file(folder_ / "killed/frames.bin", 100);
  EXPECT_THROW(resume(other), UsageError);
  other.overwrite = true;
  EXPECT_NO_THROW(resume(other));
  EXPECT_EQ(resumed_at("killed"), 0);
}

}  // namespace
}  // namespace walktrack
