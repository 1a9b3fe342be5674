#include "jobs/check/check.h"

#include <algorithm>
#include <fstream>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "checked_scene.h"
#include "core/errors.h"
#include "io/video/video.h"
#include "io/video/video_writer.h"
#include "tests/io/sample_video.h"

namespace walktrack {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;

TEST_F(CheckTest, ASoundSceneHasNothingToComplainAbout) {
  const CheckReport report = check();
  EXPECT_FALSE(report.failed()) << check_text(report);
  ASSERT_EQ(report.cameras.size(), 3u);
  EXPECT_NEAR(report.cameras[0].view.centre.z(), 2, 1e-9);
  EXPECT_EQ(report.cameras[0].video.frame_count, 30);
  EXPECT_THAT(check_text(report), HasSubstr("c0\n  stands at (5.00, -4.00), 2.00 m above"));
}

TEST_F(CheckTest, SaysThatTheHeightIsLeftToTheImages) {
  EXPECT_TRUE(check().findings.empty());
  subject_ = "subject: {mass: 60}\n";
  const CheckReport report = check();
  EXPECT_FALSE(report.failed());
  ASSERT_EQ(report.findings.size(), 1u);
  EXPECT_THAT(report.findings[0].what, HasSubstr("here 1.75 m"));
  EXPECT_THAT(report.findings[0].cure, HasSubstr("subject: {height"));
}

TEST_F(CheckTest, FindsMillimetres) {
  cameras_[1].translation *= 1000;
  write_camera(1, cameras_[1]);
  const Finding finding = only_failure(check());
  EXPECT_EQ(finding.camera, "c1");
  EXPECT_THAT(finding.what, HasSubstr("m high"));
  EXPECT_THAT(finding.cure, HasSubstr("millimetres; divide it by 1000"));
}

TEST_F(CheckTest, FindsSwappedRowsAndColumns) {
  cameras_[1].rotation.transposeInPlace();
  write_camera(1, cameras_[1]);
  const Finding finding = only_failure(check());
  EXPECT_EQ(finding.camera, "c1");
  EXPECT_THAT(finding.cure, HasSubstr("the rotation is transposed"));
}

TEST_F(CheckTest, FindsAnInvertedPose) {
  Camera& camera = cameras_[2];
  const Vector3d centre = camera_centre(camera);
  camera.rotation.transposeInPlace();
  camera.translation = centre;  // world_from_camera: (R', C)
  write_camera(2, camera);
  const Finding finding = only_failure(check());
  EXPECT_EQ(finding.camera, "c2");
  EXPECT_THAT(finding.cure, HasSubstr("are world_from_camera"));
}

TEST_F(CheckTest, FindsThePlaceForTheTranslation) {
  for (const size_t i : {0u, 1u}) {  // the third could have an inverted pose as well
    Camera wrong = cameras_[i];
    wrong.translation = camera_centre(wrong);
    write_camera(i, wrong);
    EXPECT_THAT(only_failure(check()).cure, HasSubstr("the camera's place C; store -R C")) << i;
    write_camera(i, cameras_[i]);
  }
}

TEST_F(CheckTest, FindsAWorldThatIsUpsideDown) {
  // Calibrated with z down: x_camera = R diag(1, -1, -1) x.
  for (size_t i = 0; i < cameras_.size(); ++i) {
    cameras_[i].rotation = cameras_[i].rotation * Vector3d(1, -1, -1).asDiagonal();
    write_camera(i, cameras_[i]);
  }
  const CheckReport report = check();
  ASSERT_EQ(report.findings.size(), 3u) << check_text(report);
  for (const Finding& finding : report.findings) {
    EXPECT_THAT(finding.what, HasSubstr("underground"));
    EXPECT_THAT(finding.cure, HasSubstr("ground: {normal: [0, 0, -1]}"));
  }
  EXPECT_FALSE(check("ground: {normal: [0, 0, -1]}\n").failed());  // the advice is correct
}

TEST_F(CheckTest, FindsAFloorBelowTheCalibrationsOrigin) {
  // A calibration board on a table higher than the cameras, or an origin in a corner of the wall.
  const double floor = -2.6;  // m
  for (size_t i = 0; i < cameras_.size(); ++i) {
    cameras_[i].translation -= cameras_[i].rotation * Vector3d(0, 0, floor);
    write_camera(i, cameras_[i]);
  }
  const CheckReport report = check();
  ASSERT_EQ(report.findings.size(), 3u) << check_text(report);
  for (const Finding& finding : report.findings) {
    EXPECT_THAT(finding.what, HasSubstr("underground"));
    EXPECT_THAT(finding.cure, testing::StartsWith("the floor lies below z = 0"));
  }
  EXPECT_FALSE(check("ground: {offset: -2.6}\n").failed());  // the advice is correct

  cameras_.resize(1);
  EXPECT_THAT(only_failure(check()).cure, testing::StartsWith("the floor lies below z = 0"));
}

TEST_F(CheckTest, OneCameraUndergroundMayBeMisplacedOrStandOnALowerFloor) {
  cameras_.resize(1);
  cameras_[0].translation = camera_centre(cameras_[0]);
  write_camera(0, cameras_[0]);
  const Finding finding = only_failure(check());
  EXPECT_THAT(finding.what, HasSubstr("underground"));
  EXPECT_THAT(finding.cure, HasSubstr("the camera's place C; store -R C"));
  EXPECT_THAT(finding.cure, HasSubstr("; or the floor lies below z = 0"));
}

TEST_F(CheckTest, TheFloorIsNotToBlameForOneCameraAlone) {
  cameras_[1].translation -= cameras_[1].rotation * Vector3d(0, 0, -2.6);
  write_camera(1, cameras_[1]);
  const Finding finding = only_failure(check());
  EXPECT_THAT(finding.what, HasSubstr("underground"));
  EXPECT_THAT(finding.cure, testing::Not(HasSubstr("floor")));
}

TEST_F(CheckTest, AMirroredMatrixIsRefusedByTheReader) {
  cameras_[0].rotation.row(0) *= -1;
  write_camera(0, cameras_[0]);
  try {
    check();
    FAIL() << "read a mirrored camera";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("rotation: found a mirrored matrix"));
    EXPECT_THAT(error.what(), HasSubstr("one axis has the wrong sign"));
  }
}

TEST_F(CheckTest, FindsAWrongSize) {
  cameras_[0].width_px = 128;
  write_camera(0, cameras_[0]);
  Finding finding = only_failure(check());
  EXPECT_THAT(finding.what, HasSubstr("frames are 64x48 px, the calibration is of 128x48 px"));
  EXPECT_THAT(finding.cure, HasSubstr("use the calibration of this resolution"));
  cameras_[0].width_px = 48;
  cameras_[0].height_px = 64;
  write_camera(0, cameras_[0]);
  EXPECT_THAT(only_failure(check()).cure, HasSubstr("width and height are swapped"));
}

TEST_F(CheckTest, FindsFocalLengthsInMillimetres) {
  cameras_[0].focal_px = {4.5, 4.5};
  for (const double k1 : {0.0, -0.12}) {  // whose distortion folds over with such a focal length
    set_distortion(cameras_[0], std::vector<double>{k1, 0, 0, 0, 0});
    write_camera(0, cameras_[0]);
    const CheckReport report = check();
    ASSERT_TRUE(report.failed());
    EXPECT_THAT(report.findings[0].cure, HasSubstr("must be in pixels"));
  }
}

TEST_F(CheckTest, FindsADistortionThatFolds) {
  set_distortion(cameras_[0], std::vector<double>{-2, 0, 0, 0, 0});
  write_camera(0, cameras_[0]);
  EXPECT_THAT(only_failure(check()).what, HasSubstr("folds the image over"));
}

TEST_F(CheckTest, FindsUnequalRatesAndLengths) {
  {
    VideoWriter writer(folder_ / "c1.mp4", {64, 48}, 50);
    for (int i = 0; i < 30; ++i) writer.write(sample_frame(i));
    writer.close();
  }
  Finding finding = only_failure(check());
  EXPECT_THAT(finding.what, HasSubstr("the video says 50 Hz, the scene 25 Hz"));
  EXPECT_THAT(finding.cure, HasSubstr("set frame_rate: 50"));
  write_sample_video(folder_ / "c1.mp4", 20);
  finding = only_failure(check());
  EXPECT_THAT(finding.what, HasSubstr("videos last from 0.80 s to 1.20 s"));
  EXPECT_FALSE(check("last_frame: 19\n").failed());
}

TEST_F(CheckTest, ARateThatNoVideoHasIsTheScenes) {
  cameras_.resize(2);
  const Finding finding = only_failure(check("", "frame_rate: 50\n"));
  EXPECT_EQ(finding.camera, "");
  EXPECT_THAT(finding.what, HasSubstr("the videos say 25 Hz, the scene 50 Hz"));
  EXPECT_THAT(finding.cure, HasSubstr("set frame_rate: 25 in the scene"));
}

// The remarks about a camera.
std::vector<std::string> notes(const CheckReport& report, const std::string& camera) {
  std::vector<std::string> out;
  for (const Finding& finding : report.findings)
    if (!finding.failure && finding.camera == camera) out.push_back(finding.what);
  return out;
}

TEST_F(CheckTest, FindsAVaryingFrameRateAndDroppedFrames) {
  std::vector<double> durations(30, 1);
  for (size_t i = 0; i < 10; ++i) durations[2 * i + 3] = i % 2 == 0 ? 1.5 : 0.5;
  write_uneven_video(folder_ / "c1.mp4", durations);
  const CheckReport varying = check();
  EXPECT_FALSE(varying.failed()) << check_text(varying);
  ASSERT_EQ(notes(varying, "c1").size(), 1u) << check_text(varying);
  EXPECT_THAT(notes(varying, "c1")[0], HasSubstr("the frame rate varies: 10 of 29 steps"));
  durations.assign(30, 1);
  durations[5] = 3;
  write_uneven_video(folder_ / "c1.mp4", durations);
  const CheckReport report = check();
  EXPECT_FALSE(report.failed()) << check_text(report);
  EXPECT_THAT(notes(report, "c1"), testing::ElementsAre("2 frames were dropped"));
}

TEST_F(CheckTest, SaysHowManyImagesOfAFolderAreMissing) {
  std::vector<int> numbers;
  for (int i = 0; i < 30; ++i)
    if (i != 7 && i != 8 && i != 20) numbers.push_back(i);
  std::filesystem::remove(folder_ / "c1.mp4");
  write_sample_images(folder_ / "c1.mp4", numbers);  // a folder, whatever its name
  const CheckReport report = check();
  EXPECT_FALSE(report.failed()) << check_text(report);
  EXPECT_EQ(report.cameras[1].video.frame_count, 30);
  EXPECT_THAT(check_text(report),
              HasSubstr("note: c1: 3 images are missing, by the numbers in their names\n"
                        "      cure: tracking goes on without them; the others keep their time\n"));
}

TEST_F(CheckTest, SaysThatAPhonesFramesAreTurned) {
  turn_video(folder_ / "c1.mp4", 90);
  const CheckReport raw = check();  // the calibration is for frames as they are stored
  EXPECT_FALSE(raw.failed()) << check_text(raw);
  ASSERT_EQ(notes(raw, "c1").size(), 1u) << check_text(raw);
  EXPECT_THAT(notes(raw, "c1")[0], HasSubstr("turned by 90 degrees; frames are used as stored"));
}

TEST_F(CheckTest, DrawsAPictureOfEveryCamera) {
  job_.pictures = folder_.path() / "pictures";
  check();
  for (const char* name : {"check_c0.png", "check_c1.png", "check_c2.png"}) {
    FrameSource source(job_.pictures / name);
    cv::Mat frame;
    ASSERT_TRUE(source.read(frame));
    EXPECT_EQ(frame.size(), cv::Size(64, 48));
    EXPECT_GT(cv::norm(frame, sample_frame(0), cv::NORM_INF), 100);  // something is drawn
  }
}

}  // namespace
}  // namespace walktrack
