#include "jobs/check/check_sync.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "checked_scene.h"
#include "core/rng.h"
#include "io/video/video_writer.h"
#include "jobs/render/render.h"
#include "observation/two_views/out_of_step.h"
#include "observation/two_views/pair_lag.h"
#include "synth/walk/made_walk.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

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
  EXPECT_GE(found->agreement, 0.8) << "a failure from there on";
}

// Ends of the outline agree at a wrong lag by chance for nearly a second: a shadow, or a
// figure that is still small.
TEST_F(DemoPair, NeedsASecondToTellALagFromAnother) {
  const auto found = lag([](int i) { return i < 27 ? i + 4 : i; });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->before, found->after);
  EXPECT_EQ(found->after, 0);
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

// Before its last second the ends of these two agree, after it they are those of different things,
// as if frames were missing. None are, and the scene may be tracked.
TEST(CheckRealRig, RefusesNoCamerasWhoseEndsCeaseToAgree) {
  const std::string file = shared_data("rendered/cmu_02_01/scene.yaml");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  Scene scene = read_scene(file);
  scene.cameras.erase(scene.cameras.begin());
  CheckReport report;
  check_steps(scene, {}, report);
  EXPECT_FALSE(report.failed()) << check_text(report);
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
