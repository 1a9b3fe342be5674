#include "jobs/check/check.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "core/errors.h"
#include "core/rng.h"
#include "io/calibration/formats/opencv.h"
#include "io/video/video.h"
#include "io/video/video_writer.h"
#include "jobs/check/check_sync.h"
#include "jobs/render/render.h"
#include "observation/two_views/out_of_step.h"
#include "observation/two_views/pair_lag.h"
#include "synth/walk/made_walk.h"
#include "tests/camera/made_camera.h"
#include "tests/io/sample_files.h"
#include "tests/io/sample_video.h"

namespace walktrack {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;

// 64 x 48 px, at `centre`, looking at the middle of the room.
Camera room_camera(const Vector3d& centre) {
  return looking_at(lens({64, 48}, {60, 60}, {31.5, 23.5}), centre, {0, 0, 0.9});
}

// Three cameras about a room and their videos, then one fault.
class CheckTest : public testing::Test {
 protected:
  CheckTest() {
    const std::vector<Vector3d> centres{{5, -4, 2}, {-5, -3.5, 1.6}, {0.5, 6, 2.4}};
    for (size_t i = 0; i < centres.size(); ++i) {
      cameras_.push_back(room_camera(centres[i]));
      write_camera(i, cameras_[i]);
      write_sample_video(folder_ / file_name(i, ".mp4"), 30);
    }
  }
  static std::string file_name(size_t i, const std::string& end) {
    return std::string("c").append(std::to_string(i)).append(end);
  }
  void write_camera(size_t i, const Camera& camera) {
    folder_.write(file_name(i, ".yaml"), opencv_from_camera(camera));
  }
  CheckReport check(const std::string& more = "", const std::string& rate = "frame_rate: 25\n") {
    std::string text = rate + subject_;
    text.append(more).append("cameras:\n");
    for (size_t i = 0; i < cameras_.size(); ++i) {
      text.append("  - {name: ").append(file_name(i, ""));
      text.append(", video: ").append(file_name(i, ".mp4"));
      text.append(", calibration: ").append(file_name(i, ".yaml")).append("}\n");
    }
    job_.scene = folder_.write("scene.yaml", text);
    return check_scene(job_, {});
  }
  // The only failure of the report.
  static Finding only_failure(const CheckReport& report) {
    Finding found{"", false, "no failure", ""};
    int count = 0;
    for (const Finding& finding : report.findings) {
      if (!finding.failure) continue;
      found = finding;
      ++count;
    }
    EXPECT_LE(count, 1) << check_text(report);
    return found;
  }
  TemporaryFolder folder_;
  std::vector<Camera> cameras_;
  std::string subject_ = "subject: {height: 1.75}\n";
  CheckJob job_;
};

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
  turn_video_by_90_degrees(folder_ / "c1.mp4");
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

// A point that moves on a slight curve through the room, seen by cameras of which one lags.
std::vector<FigurePath> walked_paths(const std::vector<Camera>& cameras, size_t late, int lag,
                                     double noise_px) {
  Rng rng(11, Purpose::kTest);
  std::vector<FigurePath> paths(cameras.size());
  for (size_t i = 0; i < cameras.size(); ++i) {
    for (int frame = 0; frame < 90; ++frame) {
      const double t = (frame - (i == late ? lag : 0)) / 30.0;
      const Vector3d point(1.2 * (t - 1.5), 0.5 * std::sin(t), 1.3 + 0.02 * std::sin(12 * t));
      const auto pixel = project(cameras[i], point);
      paths[i].push_back(
          MovingFigure{*pixel + noise_px * Vector2d(rng.normal(), rng.normal()), {}, {}});
    }
  }
  return paths;
}

TEST_F(CheckTest, FindsTheCameraThatIsOutOfStep) {
  // With three cameras a lag of another one may explain it as well; with four it is unique.
  for (const size_t count : {3u, 4u}) {
    if (count == 4) cameras_.push_back(room_camera({-0.5, -6, 1.8}));
    EXPECT_TRUE(find_out_of_step(cameras_, walked_paths(cameras_, 0, 0, 0.05)).empty());
    for (size_t late = 0; late < count; ++late) {
      for (const int lag : {-3, 3, 8}) {
        const auto found = find_out_of_step(cameras_, walked_paths(cameras_, late, lag, 0.05));
        const auto is_truth = [&](const OutOfStep& one) {
          return one.camera == late && one.frames_late == lag;
        };
        EXPECT_TRUE(std::any_of(found.begin(), found.end(), is_truth)) << late << " " << lag;
        if (count == 4) {
          EXPECT_TRUE(!found.empty() && is_truth(found.front()));
        }
      }
    }
  }
}

// From the videos to the advice: four cameras around a walk, one of which began six frames early.
TEST_F(CheckTest, NamesTheStartFrameThatPutsCamerasInStep) {
  RenderJob job;
  MadeWalk walk;
  walk.from = -0.2;
  walk.to = 3;
  walk.turn_rate = 0.3;
  job.walker.motion = made_walk(make_body(Subject{}, {.head = true, .arms = false}), walk);
  job.options.duration = 2.8;
  job.options.background_frames = 0;
  job.output = folder_.path() / "walk";
  for (int i = 0; i < 4; ++i) {
    RenderCamera camera;
    camera.name = file_name(static_cast<size_t>(i), "");
    camera.width_px = 320;
    camera.height_px = 240;
    camera.azimuth = -1.8 + 1.4 * i;
    camera.height = 1.5 + 0.3 * i;
    camera.start_frame = i == 2 ? 6 : 0;
    job.options.cameras.push_back(camera);
  }
  render_scene(job, {});
  job_.scene = (job.output / "scene.yaml").string();
  const CheckReport in_step = check_scene(job_, {});
  EXPECT_FALSE(in_step.failed()) << check_text(in_step);
  std::string scene = read_file(job.output / "scene.yaml");
  const std::string said = ", start_frame: 6";
  scene.replace(scene.find(said), said.size(), "");
  job_.scene = folder_.write("walk/scene.yaml", scene);
  const CheckReport report = check_scene(job_, {});
  const auto finding = std::ranges::find_if(report.findings, [](const Finding& each) {
    return each.failure && each.what.find("are out of step") != std::string::npos;
  });
  ASSERT_NE(finding, report.findings.end()) << check_text(report);
  EXPECT_THAT(finding->cure, testing::StartsWith("start_frame: 6 for c2"));
}

// The demo's two cameras, with the second one's frames taken from other places of its path.
class DemoPair : public testing::Test {
 protected:
  DemoPair() : scene_(read_scene(WALKTRACK_SOURCE_DIR "/data/demo/scene.yaml")) {
    for (const SceneCamera& camera : scene_.cameras) cameras_.push_back(camera.camera);
    paths_ = figures_in(scene_, {}).paths;
  }
  std::optional<PairLag> lag(const std::function<int(int)>& taken) const {
    std::vector<FigurePath> paths = paths_;
    for (int i = 0; i < std::ssize(paths[1]); ++i) {
      const int from = taken(i);
      const bool there = from >= 0 && from < std::ssize(paths_[1]);
      paths[1][size_t(i)] = there ? paths_[1][size_t(from)] : std::nullopt;
    }
    return find_pair_lag(cameras_, paths, 30);
  }
  Scene scene_;
  std::vector<Camera> cameras_;
  std::vector<FigurePath> paths_;
};

TEST_F(DemoPair, TellsByHowManyFramesTwoCamerasAreOutOfStep) {
  for (const int late : {-20, -6, -3, -2, 0, 2, 3, 6, 20}) {
    const auto found = lag([&](int i) { return i - late; });
    ASSERT_TRUE(found) << late;
    EXPECT_EQ(found->before, found->after) << late;
    EXPECT_NEAR(found->after, late, std::abs(late) > 15 ? 1 : 0);
  }
}

// A camera that is half a metre, a step, further along the walk than its calibration states shows
// the same as a camera that began a step late, so that no lag is reported.
TEST_F(DemoPair, RecognisesLagsThatAWrongPositionWouldExplain) {
  for (const int late : {-6, -3, 3, 6}) {
    const auto found = lag([&](int i) { return i - late; });
    ASSERT_TRUE(found) << late;
    EXPECT_FALSE(found->may_be_steps) << late;
  }
  Camera& front = cameras_[1];
  front.translation += front.rotation * Eigen::Vector3d(0.5, 0, 0);
  const auto found = lag([](int i) { return i; });
  ASSERT_TRUE(found);
  EXPECT_GT(found->after, 10);
  EXPECT_TRUE(found->may_be_steps);
}

TEST_F(DemoPair, TellsWhereFramesAreMissing) {
  const auto found = lag([](int i) { return i < 57 ? i : i + 6; });
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->before, 0, 1);
  EXPECT_NEAR(found->after, -6, 1);
  EXPECT_NEAR(found->changes_at, 57, 9);
}

TEST_F(DemoPair, ReportsNothingIfTheSubjectStandsOrIsMissing) {
  EXPECT_FALSE(lag([](int) { return -1; }));
  for (FigurePath& path : paths_) path.assign(path.size(), path[60]);
  EXPECT_FALSE(lag([](int i) { return i; }));
}

// Two cameras of recordings that were not used to set any constant.
TEST(CheckRealRig, FindsTwoTelephonesOutOfStep) {
  const std::string file = shared_data("opencap_two_phones/scene.yaml");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  Scene scene = read_scene(file);
  std::vector<Camera> cameras;
  for (const SceneCamera& camera : scene.cameras) cameras.push_back(camera.camera);
  for (const int late : {0, 6}) {
    scene.cameras[1].start_frame = late;
    const SeenFigures seen = figures_in(scene, {});
    const auto lag = find_pair_lag(cameras, seen.paths, seen.frame_rate);
    ASSERT_TRUE(lag);
    EXPECT_NEAR(lag->after, -late, 1);
    EXPECT_EQ(lag->before, lag->after);
  }
}

// One camera misses the head, and in the other one the shadow reaches the feet: the ends do not
// correspond, and no lag may be reported.
TEST(CheckRealRig, SaysNothingWrongOfTwoCamerasThatSeeDifferentEnds) {
  const std::string file = shared_data("rendered/cmu_02_01/scene.yaml");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const Scene scene = read_scene(file);
  const SeenFigures seen = figures_in(scene, {});
  for (const int late : {-6, -3, 0, 3, 6}) {
    FigurePath shifted(seen.paths[1].size());
    for (int i = 0; i < std::ssize(shifted); ++i)
      if (i - late >= 0 && i - late < std::ssize(shifted))
        shifted[size_t(i)] = seen.paths[1][size_t(i - late)];
    const auto lag = find_pair_lag({scene.cameras[0].camera, scene.cameras[1].camera},
                                   {seen.paths[0], shifted}, seen.frame_rate);
    EXPECT_NEAR(lag ? lag->after : late, late, 1);
  }
}

TEST_F(CheckTest, SaysNothingAboutStepsWithoutAFigure) {
  const std::vector<FigurePath> empty(3, FigurePath(90, std::nullopt));
  EXPECT_TRUE(find_out_of_step(cameras_, empty).empty());
}

TEST_F(CheckTest, FollowsTheMovingFigure) {
  {
    VideoWriter writer(folder_ / "c0.mp4", {64, 48}, 25);
    for (int i = 0; i < 40; ++i) {
      cv::Mat frame(48, 64, CV_8UC3, cv::Scalar::all(90));
      frame(cv::Rect(4 + i, 10, 6, 20)).setTo(cv::Scalar::all(240));
      writer.write(frame);
    }
    writer.close();
  }
  check();
  const Scene scene = read_scene(folder_ / "scene.yaml");
  const FigurePath path = figures_in(scene, {}).paths[0];
  ASSERT_EQ(path.size(), 30u);  // as many as for the other cameras
  ASSERT_TRUE(path[20]);
  EXPECT_NEAR(path[20]->middle.x(), 4 + 20 + 2.5, 1.0);
  EXPECT_NEAR(path[20]->middle.y(), 10 + 3.5, 1.5);  // the middle of its upper 40 %
  ASSERT_FALSE(path[20]->tops.empty());
  EXPECT_NEAR(path[20]->tops[0].y(), 9.5, 1);
  EXPECT_NEAR(path[20]->bottoms[0].y(), 29.5, 1);
}

TEST(CheckRealRig, FindsThreeFramesInRenderedWalks) {
  const std::string folder = shared_data("rendered/cmu_02_01");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  Scene scene = read_scene(folder + "/scene.yaml");
  std::vector<Camera> cameras;
  for (const SceneCamera& camera : scene.cameras) cameras.push_back(camera.camera);
  const std::vector<FigurePath> paths = figures_in(scene, {}).paths;
  EXPECT_TRUE(find_out_of_step(cameras, paths).empty());
  for (size_t late = 0; late < paths.size(); ++late) {
    auto shifted = paths;
    shifted[late].insert(shifted[late].begin(), 3, std::nullopt);
    const auto found = find_out_of_step(cameras, shifted);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found.front().camera, late);
    EXPECT_EQ(found.front().frames_late, 3);
  }
}

}  // namespace
}  // namespace walktrack
