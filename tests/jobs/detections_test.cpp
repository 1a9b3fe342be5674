#include "jobs/track/input/detections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "jobs/track/input/pose_model.h"
#include "tests/io/sample_files.h"
#include "tests/message_of.h"

namespace walktrack {
namespace {

using testing::HasSubstr;

std::string person_json() {
  std::string numbers;
  for (int i = 0; i < 17; ++i) numbers += std::string(i ? ", " : "") + "20, 30, 0.9";
  return R"({"people": [{"pose_keypoints_2d": [)" + numbers + "]}]}";
}

// Looks along +x from 1.2 m above the origin.
Camera level_camera(double focal_px) {
  Camera camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.focal_px = {focal_px, focal_px};
  camera.centre_px = {320, 240};
  camera.rotation << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  camera.translation = {0, 1.2, 0};
  return camera;
}

class DetectionsTest : public testing::Test {
 protected:
  DetectionsTest() {
    folder_.write("a.yaml", kCalibrationText);
    folder_.write("a.mp4", "");
    folder_.write("points/a_000000000005_keypoints.json", person_json());
  }
  Scene scene(const std::string& cameras) const {
    return read_scene(folder_.write("scene.yaml", "frame_rate: 30\ncameras:\n" + cameras));
  }
  Scene with_files() const {
    return scene("  - {name: a, video: a.mp4, calibration: a.yaml, keypoints: points}\n");
  }
  static Detections of(const Scene& scene, const KeypointConfig& config = {}) {
    return Detections(scene, config, *scene.frame_rate,
                      std::vector<WorkingScale>(scene.cameras.size(), {40, 1}));
  }
  TemporaryFolder folder_;
  const FrameSource picture_{cv::Mat::zeros(48, 64, CV_8UC3), 9};
};

TEST_F(DetectionsTest, FilesAreAskedByTheVideosOwnNumber) {
  Detections detections = of(with_files());
  EXPECT_TRUE(detections.on());
  EXPECT_FALSE(detections.uses_network());
  EXPECT_TRUE(detections.look(0, {picture_, 0, 5, {}, true}).empty());
  EXPECT_EQ(detections.look(0, {picture_, 5, 0, {}, true}).size(), 1u);
  EXPECT_THAT(detections.notes({9}),
              testing::ElementsAre("keypoints of camera a: keypoints end with frame 5, the video "
                                   "with frame 8"));
}

TEST_F(DetectionsTest, AutoIsForFilesAndForOneCameraThatSeesEnough) {
  Config config;
  KeypointConfig& keypoints = config.observation.keypoints;
  EXPECT_TRUE(keypoints_wanted(with_files(), config));
  const std::string camera = "  - {name: NAME, video: a.mp4, calibration: a.yaml}\n";
  Scene alone = scene(replaced(camera, "NAME", "a"));
  alone.initial.emplace().position = {5, 0};
  alone.cameras[0].camera = level_camera(480);  // 168 px
  EXPECT_EQ(keypoints_wanted(alone, config), has_pose_net());
  alone.cameras[0].camera = level_camera(120);
  EXPECT_FALSE(keypoints_wanted(alone, config));
  std::string cameras;
  for (const char* name : {"a", "b", "c"}) cameras += replaced(camera, "NAME", name);
  EXPECT_FALSE(keypoints_wanted(scene(cameras), config));
  keypoints.enabled = TermSetting::kOff;
  EXPECT_FALSE(keypoints_wanted(with_files(), config));
  keypoints.enabled = TermSetting::kOn;
  EXPECT_TRUE(keypoints_wanted(scene(cameras), config));
}

TEST_F(DetectionsTest, OneCameraThatSeesPeopleTooSmallSaysThatNamesRestOnOutlines) {
  Config config;
  Scene alone = scene("  - {name: a, video: a.mp4, calibration: a.yaml}\n");
  alone.initial.emplace().position = {5, 0};
  const auto note = [&](double focal_px) {
    alone.cameras[0].camera = level_camera(focal_px);
    return missing_network_note(alone, config);
  };
  EXPECT_THAT(note(120), HasSubstr("people are 42 px high in the video, the network needs 150 px"));
  EXPECT_EQ(note(480).empty(), has_pose_net());
  config.observation.keypoints.enabled = TermSetting::kOff;
  EXPECT_EQ(note(120), "") << "known to whoever has set it";
  config.observation.keypoints.enabled = TermSetting::kAuto;
  alone.cameras.push_back(alone.cameras[0]);
  EXPECT_EQ(note(120), "") << "two cameras tell";
}

// From two sides outlines tell left from right by themselves, unless the room behind has to be
// learned while somebody stands in it.
TEST_F(DetectionsTest, AutoIsForTwoCamerasWithoutPicturesOfTheEmptyScene) {
  Config config;
  const auto two = [&](const std::string& more) {
    Scene out = scene("  - {name: a, video: a.mp4, calibration: a.yaml" + more +
                      "}\n  - {name: b, video: a.mp4, calibration: a.yaml" + more + "}\n");
    out.initial.emplace().position = {5, 0};
    for (SceneCamera& camera : out.cameras) camera.camera = level_camera(480);
    return out;
  };
  const auto asked = [&](const std::string& more) {
    const ObservationConfig terms = decided(two(more), config).observation;
    EXPECT_EQ(terms.background.without_people, terms.keypoints.enabled);
    return terms.keypoints.enabled == TermSetting::kOn;
  };
  EXPECT_EQ(asked(""), has_pose_net());
  EXPECT_FALSE(asked(", background: a.mp4"));
  config.observation.keypoints.enabled = TermSetting::kOff;
  EXPECT_FALSE(asked(""));
  config.observation.background.without_people = TermSetting::kOn;
  EXPECT_EQ(decided(two(""), config).observation.background.without_people, TermSetting::kOn);
}

TEST_F(DetectionsTest, FlowIsForThoseWhoAskForIt) {
  const Scene one = scene("  - {name: a, video: a.mp4, calibration: a.yaml, keypoints: points}\n");
  Config config;
  const auto flow = [&] { return decided(one, config).observation.flow.enabled; };
  EXPECT_EQ(flow(), TermSetting::kOff) << "by default, which is auto";
  config.observation.flow.enabled = TermSetting::kOn;
  EXPECT_EQ(flow(), TermSetting::kOn);
  config.observation.flow.enabled = TermSetting::kOff;
  EXPECT_EQ(flow(), TermSetting::kOff);
  EXPECT_EQ(decided(one, config).observation.keypoints.enabled, TermSetting::kOn);
}

// Unless the configuration states them.
TEST_F(DetectionsTest, ThreeCamerasNeedFewerParticles) {
  const Scene one = scene("  - {name: a, video: a.mp4, calibration: a.yaml}\n");
  Scene two = one, three = one;
  two.cameras.resize(2, one.cameras[0]);
  three.cameras.resize(3, one.cameras[0]);
  Config config;
  const auto particles = [&](const Scene& scene) {
    const TrackerConfig tracker = decided(scene, config).tracker;
    return std::pair(tracker.filter.particles, tracker.start.particles);
  };
  EXPECT_EQ(particles(one), std::pair(200, 150));
  EXPECT_EQ(particles(two), std::pair(200, 150));
  EXPECT_EQ(particles(three), std::pair(100, 75));
  config.tracker.filter.particles = 30;
  config.tracker.start.particles = 20;
  EXPECT_EQ(particles(one), std::pair(30, 20));
  EXPECT_EQ(particles(three), std::pair(30, 20));
}

// Unless the configuration states it.
TEST_F(DetectionsTest, FeetMaySlideFurtherBeforeSeveralCameras) {
  const Scene one = scene("  - {name: a, video: a.mp4, calibration: a.yaml}\n");
  Scene two = one;
  two.cameras.resize(2, one.cameras[0]);
  Config config;
  EXPECT_EQ(decided(one, config).quality.foot_slide, 0.07);
  EXPECT_EQ(decided(two, config).quality.foot_slide, 0.1);
  config.quality.foot_slide = 0.2;
  EXPECT_EQ(decided(one, config).quality.foot_slide, 0.2);
}

// Keypoints correct outlines, and several cameras' outlines the labels of keypoints, unless the
// configuration states weights.
TEST_F(DetectionsTest, OutlinesCountForLessBesideKeypoints) {
  const Scene one = scene("  - {name: a, video: a.mp4, calibration: a.yaml, keypoints: points}\n");
  Scene two = one;
  two.cameras.resize(2, one.cameras[0]);
  Config config;
  const auto weights = [&](const Scene& scene) {
    const ObservationConfig terms = decided(scene, config).observation;
    return std::array{terms.outline_share, terms.keypoints.weight, terms.keypoints.flip};
  };
  EXPECT_EQ(weights(one), (std::array{1.0 / 3, 1.0, 0.1}));
  EXPECT_EQ(weights(two), (std::array{1.0 / 3, 1.0, 0.5}));
  config.observation.keypoints.enabled = TermSetting::kOff;
  EXPECT_EQ(weights(one)[0], 1) << "without keypoints";
  EXPECT_EQ(weights(two)[0], 1) << "without keypoints";
  config.observation.keypoints.enabled = TermSetting::kOn;
  config.observation.outline_share = 0.5;
  config.observation.keypoints.weight = 0.7;
  config.observation.keypoints.flip = 0.2;
  EXPECT_EQ(weights(one), (std::array{0.5, 0.7, 0.2}));
  EXPECT_EQ(weights(two), (std::array{0.5, 0.7, 0.2}));
}

TEST_F(DetectionsTest, SaysThatTheModelIsMissing) {
  const Scene without = scene("  - {name: a, video: a.mp4, calibration: a.yaml}\n");
  const KeypointConfig config{.enabled = TermSetting::kOn, .model = "none.onnx"};
  EXPECT_FALSE(message_of<std::runtime_error>([&] { of(without, config); }).empty());
}

// In a slow video every third frame would be too few a second.
TEST(FramesBetweenLooks, FollowFromTheFrameRate) {
  const auto frames = [](double frame_rate) { return frames_between_looks({}, frame_rate); };
  EXPECT_EQ(frames(60), 3);
  EXPECT_EQ(frames(30 / 1.001), 3);
  EXPECT_EQ(frames(15), 2);
  EXPECT_EQ(frames(7), 1);
  EXPECT_EQ(frames_between_looks({.every = 5}, 15), 5) << "as configured";
}

TEST_F(DetectionsTest, NetworkLooksAtEveryNthFrame) {
  if (!has_pose_net()) GTEST_SKIP() << "built without OpenCV's dnn module";
  ASSERT_TRUE(pose_model_file(std::string(kShippedModel)));
  const Scene without = scene("  - {name: a, video: a.mp4, calibration: a.yaml}\n");
  Detections detections = of(without, {.enabled = TermSetting::kOn, .every = 2});
  EXPECT_TRUE(detections.uses_network());
  const Region around{{10, 5, 40, 45}, 0.04, false};
  EXPECT_EQ(detections.look(0, {picture_, 0, 0, around, true}).size(), 1u);
  EXPECT_TRUE(detections.look(0, {picture_, 1, 1, around, true}).empty());
  EXPECT_TRUE(detections.look(0, {picture_, 2, 2, {}, true}).empty());  // outside the image
  Region unasked = around;
  unasked.points = false;
  EXPECT_TRUE(detections.look(0, {picture_, 4, 4, unasked, true}).empty());
}

TEST_F(DetectionsTest, OfAnotherImageSizeAreRefused) {
  std::string text = person_json();
  for (size_t at = 0; (at = text.find("20, 30", at)) != std::string::npos;)
    text.replace(at, 6, "900, 30");
  folder_.write("points/a_000000000005_keypoints.json", text);
  EXPECT_THAT(message_of([&] { of(with_files()); }),
              HasSubstr("points: found points as far as (900, 30) px, allowed: 64x48 px"));
}

}  // namespace
}  // namespace walktrack
