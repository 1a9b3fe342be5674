// The images of the empty scene show a carpet that the video does not.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "io/archive/files.h"
#include "io/scene/scene.h"
#include "io/tables/motion_file.h"
#include "io/video/video.h"
#include "jobs/check/check.h"
#include "jobs/track/track.h"
#include "metrics/joint_error.h"
#include "tests/data_folders.h"
#include "tests/io/sample_files.h"

namespace walktrack {
namespace {

using testing::HasSubstr;

class CarpetInTheEmptyScene : public testing::Test {
 protected:
  std::filesystem::path scene(bool carpet) {
    const std::string demo = kDemo.string();
    std::string text = "frame_rate: 30\nsubject: {height: 1.75, mass: 70}\ncameras:\n";
    for (const std::string name : {"front", "side"}) {
      cv::Mat picture;
      FrameSource(kDemo / (name + "_background.mp4")).read(picture);
      if (carpet) {
        const int width = picture.cols, height = picture.rows;
        picture(cv::Rect(width / 5, height * 2 / 3, width / 2, height / 6)) =
            cv::Scalar(40, 40, 140);
      }
      cv::imwrite(folder_ / (name + ".png"), picture);
      text += "  - {name: " + name + ", video: " + demo + "/" + name +
              ".mp4, calibration: " + demo + "/" + name + ".yaml, background: " + name + ".png}\n";
    }
    return folder_.write("scene.yaml", text);
  }
  TemporaryFolder folder_;
};

TEST_F(CarpetInTheEmptyScene, IsNamedByCheck) {
  CheckJob job;
  job.scene = scene(false);
  EXPECT_TRUE(check_scene(job, {}).findings.empty());
  job.scene = scene(true);
  const CheckReport report = check_scene(job, {});
  EXPECT_FALSE(report.failed());
  ASSERT_EQ(report.findings.size(), 2u);
  EXPECT_EQ(report.findings[1].camera, "side");
  EXPECT_THAT(report.findings[1].what, HasSubstr("never looks like the images of the empty scene"));
}

TEST_F(CarpetInTheEmptyScene, IsNotTakenForTheSubject) {
  TrackJob job;
  job.scene = read_scene(scene(true));
  job.output = folder_ / "tracked";
  job.overlay = false;
  EXPECT_EQ(track_scene(job, {}).status, TrackStatus::kTracked);
  EXPECT_THAT(read_text_file(folder_ / "tracked/run.json", size_t{1} << 20),
              HasSubstr("% of the picture never looks like the images of the empty scene"));
  const JointErrors errors =
      joint_errors(read_motion(kDemo / "truth.csv"), read_motion(folder_ / "tracked/joints.csv"));
  EXPECT_LT(errors.absolute.mean, 0.03);
}

}  // namespace
}  // namespace walktrack
