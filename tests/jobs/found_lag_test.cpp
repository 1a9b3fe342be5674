// One of two cameras begins late and the scene does not state it: the lag is estimated from the
// walk.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/scene/scene.h"
#include "io/tables/motion_file.h"
#include "io/video/video.h"
#include "jobs/check/check.h"
#include "jobs/track/track.h"
#include "metrics/joint_error.h"
#include "tests/data_folders.h"
#include "tests/io/sample_video.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

constexpr int kLate = 6;  // frames of the scene that the front camera missed
constexpr double kDemoRate = 30;

class FoundLag : public testing::Test {
 protected:
  FoundLag() {
    FrameSource source(kDemo / "front.mp4");
    std::vector<cv::Mat> frames;
    cv::Mat frame;
    for (int i = 0; source.read(frame); ++i)
      if (i >= kLate) frames.push_back(frame.clone());
    write_timed_video(folder_ / "front.mp4", frames, kDemoRate,
                      std::vector<double>(frames.size(), 1));
  }
  // `front`: further keys of the front camera.
  Scene scene(const std::string& front) const {
    const std::string demo = kDemo.string();
    return read_scene(folder_.write(
        "scene.yaml",
        "subject: {height: 1.75, mass: 70}\nlast_frame: 70\ncameras:\n  - {name: side, video: " +
            demo + "/side.mp4, calibration: " + demo + "/side.yaml, background: " + demo +
            "/side_background.mp4}\n  - {name: front, video: front.mp4, calibration: " + demo +
            "/front.yaml, background: " + demo + "/front_background.mp4" + front + "}\n"));
  }
  TrackJob job(const std::string& front) const {
    TrackJob out;
    out.scene = scene(front);
    out.config.values.tracker.filter.particles = 150;
    out.output = folder_ / "tracked";
    out.overlay = false;
    return out;
  }
  TemporaryFolder folder_;
};

TEST_F(FoundLag, IsCorrectedAndStated) {
  const TrackOutcome outcome = track_scene(job(""), {});
  ASSERT_TRUE(outcome.lag);
  EXPECT_EQ(outcome.lag->camera, 0u);
  EXPECT_EQ(outcome.lag->frames, kLate);
  EXPECT_GT(outcome.lag->sd_frames, 0);
  EXPECT_LT(outcome.lag->sd_frames, 1.5);
  const auto run = nlohmann::json::parse(read_text_file(folder_ / "tracked/run.json", 1 << 24));
  EXPECT_EQ(run["numbers"]["lag_frames_side"], kLate);
  EXPECT_THAT(run["notes"].dump(), testing::HasSubstr("side shows things 6 frames later"));
  // Time 0 is the beginning of the camera that began last.
  Motion found = read_motion(folder_ / "tracked/joints.csv");
  for (double& time : found.time) time += kLate / kDemoRate;
  EXPECT_LT(joint_errors(read_motion(kDemo / "truth.csv"), found).absolute.mean, 0.05);
}

// Videos whose lengths differ by the lag are not taken for videos with lost frames.
TEST_F(FoundLag, ExplainsUnequalLengths) {
  Scene open = scene("");
  open.last_frame.reset();
  const CheckReport report = look_at_scene(open, {});
  EXPECT_THAT(check_text(report), testing::HasSubstr("videos last from"));
  EXPECT_FALSE(report.failed()) << check_text(report);
}

TEST_F(FoundLag, StatedStartsAreNotCorrected) {
  EXPECT_FALSE(look_at_scene(scene(""), {}).failed());
  const CheckReport stated = look_at_scene(scene(", start_frame: 0"), {});
  EXPECT_TRUE(stated.failed());
  EXPECT_FALSE(stated.lag);
  EXPECT_THROW(track_scene(job(", start_frame: 0"), {}), InputError);
}

}  // namespace
}  // namespace walktrack
