#include "jobs/track/results/overlay_video.h"

#include <stdexcept>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "io/video/video.h"
#include "tests/data_folders.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

constexpr double kRate = 30;

FrameRecord standing_at(const Eigen::Vector2d& place) {
  FrameRecord record;
  record.tracked = true;
  record.estimate.joint_count = kJointCountWithoutArms;
  const auto at = [&](double z) { return Eigen::Vector3d(place.x(), place.y(), z); };
  record.estimate.joints.at.fill(at(0.95));
  record.estimate.joints[Joint::kNeck] = at(1.5);
  record.estimate.joints[Joint::kHead] = at(1.65);
  return record;
}

class OverlayVideo : public testing::Test {
 protected:
  OverlayVideo() {
    job_.scene = read_scene(kDemo / "scene.yaml");
    job_.output = folder_;
  }
  // A person in the middle of the demo's ground, or nobody.
  TrackedFrames frames(const std::vector<bool>& tracked) const {
    TrackedFrames out{kRate, FrameFile(folder_ / "frames.bin")};
    fs::remove(folder_ / "frames.bin");
    for (const bool each : tracked) out.records.append(each ? standing_at({0, 0}) : FrameRecord{});
    return out;
  }
  std::vector<ReportClip> write(const TrackedFrames& frames, int threads = 2,
                                const JobControl& control = {}) const {
    const ResultFolder folder(track_outputs(job_), true);
    return write_overlays(job_, frames, folder, threads, control);
  }
  std::vector<cv::Mat> pictures_of(const fs::path& file) const {
    FrameSource source(file);
    std::vector<cv::Mat> out;
    for (cv::Mat frame; source.read(frame);) out.push_back(frame.clone());
    return out;
  }
  std::vector<std::string> files() const {
    std::vector<std::string> out;
    for (const auto& each : fs::recursive_directory_iterator(folder_))
      if (each.path().string().find("mp4") != std::string::npos)
        out.push_back(each.path().filename().string());
    return out;
  }
  OverlayConfig& config() { return job_.config.values.overlay; }

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
  TrackJob job_;
};

TEST_F(OverlayVideo, IsAsWideAsWantedAndHoldsEveryFrame) {
  config().width = 320;
  const std::vector<ReportClip> clips = write(frames(std::vector<bool>(7, true)));
  ASSERT_EQ(clips.size(), 2u);
  for (const ReportClip& clip : clips) {
    const std::vector<cv::Mat> pictures = pictures_of(clip.file);
    ASSERT_EQ(pictures.size(), 7u);
    EXPECT_EQ(pictures[0].size(), cv::Size(320, 240));
  }
}

TEST_F(OverlayVideo, ShowsAWindowAroundTheWalkerIfWanted) {
  config().crop = true;
  const std::vector<ReportClip> clips = write(frames(std::vector<bool>(3, true)));
  const cv::Mat whole = pictures_of(kDemo / "side.mp4").front();
  const cv::Mat shown = pictures_of(clips[0].file).front();
  EXPECT_LT(shown.cols * whole.rows, shown.rows * whole.cols);  // narrower, because people are
                                                                // upright
  EXPECT_GE(shown.rows, 470);
}

TEST_F(OverlayVideo, IsTheSameForAnyThreadCount) {
  std::vector<std::string> bytes;
  for (const int threads : {1, 2, 5})
    for (const ReportClip& clip : write(frames({true, false, true, true}), threads))
      bytes.push_back(read_file(clip.file));
  ASSERT_EQ(bytes.size(), 6u);
  for (size_t i = 2; i < bytes.size(); ++i) EXPECT_EQ(bytes[i], bytes[i % 2]);
}

// A camera with half the rate shows each image twice; the figure of the first time is not in the
// second.
TEST_F(OverlayVideo, DrawsIntoAPictureThatIsShownTwiceAnew) {
  job_.scene.frame_rate = kRate;
  job_.scene.cameras[0].frame_rate = kRate / 4;
  const std::vector<cv::Mat> drawn =
      pictures_of(write(frames({false, false, true, false, false}))[0].file);
  ASSERT_EQ(drawn.size(), 5u);
  const auto changed = [&](int a, int b) {
    cv::Mat difference;
    cv::absdiff(drawn[size_t(a)], drawn[size_t(b)], difference);
    difference.rowRange(0, 60).setTo(cv::Scalar::all(0));  // the caption
    return cv::norm(difference, cv::NORM_INF);
  };
  EXPECT_GT(changed(2, 3), 100);
  EXPECT_LT(changed(3, 4), 40);
  EXPECT_GT(changed(2, 4), 100);
}

TEST_F(OverlayVideo, LeavesNoHalfFile) {
  JobControl control;
  control.report = [](const Progress& progress) {
    if (progress.done == 4) throw std::logic_error("stopped");
  };
  EXPECT_THROW(write(frames(std::vector<bool>(8, true)), 2, control), std::logic_error);
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace walktrack
