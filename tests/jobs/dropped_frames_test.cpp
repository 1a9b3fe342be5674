// One of two cameras drops frames: by its time stamps the others keep their times.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "io/archive/files.h"
#include "io/scene/scene.h"
#include "io/tables/motion_file.h"
#include "io/video/video.h"
#include "jobs/track/track.h"
#include "metrics/joint_error.h"
#include "tests/data_folders.h"
#include "tests/io/sample_video.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

constexpr int kDemoFrames = 75;

class DroppedFrames : public testing::Test {
 protected:
  // The front camera's video without some of its frames.
  void record(int first, int count) const {
    FrameSource source(kDemo / "front.mp4");
    std::vector<cv::Mat> frames;
    std::vector<double> durations;
    cv::Mat frame;
    for (int i = 0; i < kDemoFrames && source.read(frame); ++i) {
      if (i >= first && i < first + count) {
        durations.back() += 1;
        continue;
      }
      frames.push_back(frame.clone());
      durations.push_back(1);
    }
    write_timed_video(folder_ / "front.mp4", frames, 30, durations);
  }
  // Mean error of the joints, m. No rate is stated, and the first camera is the one that drops
  // frames.
  double tracked() const {
    const std::string demo = kDemo.string();
    std::string text = "subject: {height: 1.75, mass: 70}\nlast_frame: 70\ncameras:\n";
    text += "  - {name: front, video: front.mp4, calibration: " + demo +
            "/front.yaml, background: " + demo + "/front_background.mp4}\n";
    text += "  - {name: side, video: " + demo + "/side.mp4, calibration: " + demo +
            "/side.yaml, background: " + demo + "/side_background.mp4}\n";
    TrackJob job;
    job.scene = read_scene(folder_.write("scene.yaml", text));
    job.config.values.tracker.filter.particles = 150;
    job.output = folder_ / "tracked";
    job.overlay = false;
    job.overwrite = true;
    const TrackOutcome outcome = track_scene(job, {});
    EXPECT_EQ(outcome.frames, 71);
    return joint_errors(read_motion(kDemo / "truth.csv"),
                        read_motion(folder_ / "tracked/joints.csv"))
        .absolute.mean;
  }
  TemporaryFolder folder_;
};

TEST_F(DroppedFrames, CostHardlyAnyAccuracy) {
  record(0, 0);
  const double clean = tracked();
  record(40, 6);
  EXPECT_LT(tracked(), 1.5 * clean);
}

}  // namespace
}  // namespace walktrack
