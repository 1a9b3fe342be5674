#include "io/scene/scene.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/conventions.h"
#include "core/errors.h"
#include "tests/io/sample_files.h"
#include "tests/message_of.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;

const std::string kCamera = "cameras:\n  - {name: a, video: a.mp4, calibration: a.yaml}\n";

// A folder with the files to which scenes of these tests refer.
class SceneFile : public testing::Test {
 protected:
  SceneFile() {
    folder_.write("a.yaml", kCalibrationText);
    folder_.write("a.mp4", "");
    folder_.write("truth.csv", "");
  }
  Scene read(const std::string& text) { return read_scene(folder_.write("scene.yaml", text)); }
  std::string message_for(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no InputError";
  }
  TemporaryFolder folder_;
};

TEST_F(SceneFile, NeedsOnlyACamera) {
  const Scene scene = read(kCamera);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].video, folder_.path() / "a.mp4");
  EXPECT_TRUE(scene.cameras[0].background.empty());
  EXPECT_EQ(scene.cameras[0].camera.width_px, 64);
  EXPECT_EQ(scene.subject.height, 1.75);
  EXPECT_EQ(scene.subject.mass, 70);
  EXPECT_FALSE(scene.height_given || scene.mass_given);
  EXPECT_EQ(scene.gravity, Vector3d(0, 0, -kStandardGravity));
  EXPECT_FALSE(scene.initial || scene.frame_rate || scene.last_frame);
  EXPECT_TRUE(scene.truth.empty());
}

TEST_F(SceneFile, ReadsKeypointsWithAndWithoutAMap) {
  folder_.write("points.json", "");
  const Scene plain = read(replaced(kCamera, "}", ", keypoints: points.json}"));
  EXPECT_EQ(plain.cameras[0].keypoints.path, folder_.path() / "points.json");
  EXPECT_TRUE(plain.cameras[0].keypoints.names.empty());
  const Scene mapped = read(replaced(
      kCamera, "}", ", keypoints: {file: points.json, map: {left_knee: kneeL, nose: snout}}}"));
  EXPECT_EQ(mapped.cameras[0].keypoints.names.at("left_knee"), "kneeL");
  EXPECT_EQ(mapped.cameras[0].keypoints.names.size(), 2u);
}

// If a video may not leave an institution, its keypoints may.
TEST_F(SceneFile, NeedsNoVideoWhereThereAreKeypoints) {
  folder_.write("points.json", "");
  const std::string text = "cameras:\n  - {name: a, calibration: a.yaml, keypoints: points.json}\n";
  EXPECT_TRUE(read(text).cameras[0].video.empty());
  EXPECT_THAT(message_for(replaced(text, ", keypoints: points.json", "")),
              HasSubstr("cameras[0]: found neither 'video' nor 'keypoints', allowed: one of them"));
  EXPECT_THAT(
      message_for(replaced(text, "points.json}", "points.json, background: a.mp4}")),
      HasSubstr("cameras[0].background: found pictures of the empty scene without a video"));
  EXPECT_THAT(message_for(replaced(text, "points.json", "none.json")),
              HasSubstr("cameras[0].keypoints: found 'none.json'"));
  EXPECT_THAT(message_for(replaced(text, "points.json", "{file: points.json, map: {knee: x}}")),
              HasSubstr("cameras[0].keypoints.map"));
}

TEST_F(SceneFile, ReadsEveryKey) {
  const Scene scene = read(
      "cameras:\n"
      "  - name: a\n    video: frames_%03d.png\n    calibration: a.yaml\n    background: a.mp4\n"
      "    start_frame: 3\n    frame_rate: 25\n"
      "frame_rate: 50\n"
      "ground: {normal: [0, 0, 2], offset: 0.2}\n"
      "gravity: [0.5, 0, -9.8]\n"
      "subject: {height: 1.6, mass: 55, lengths: {thigh: 0.41, hip_width: 0.16}}\n"
      "initial: {time: 0.5, position: [1, 2], heading: -0.3, speed: 1.2, phase: 0.25}\n"
      "occluders: {a: [[[0, 0], [10, 0], [10, 10]]]}\n"
      "truth: truth.csv\nfirst_frame: 5\nlast_frame: 9\n");
  const SceneCamera& camera = scene.cameras[0];
  EXPECT_EQ(camera.video, folder_.path() / "frames_%03d.png");
  EXPECT_EQ(camera.start_frame, 3);
  EXPECT_EQ(camera.frame_rate, 25);
  EXPECT_EQ(camera.occluders.at(0).outline.at(1), Vector2d(10, 0));
  EXPECT_NEAR(camera_centre(camera.camera).z(), 1 - 0.1, 1e-12);  // n.x = d has n of length 2
  EXPECT_EQ(scene.frame_rate, 50);
  EXPECT_EQ(scene.gravity, Vector3d(0.5, 0, -9.8));
  EXPECT_EQ(scene.subject.height, 1.6);
  EXPECT_TRUE(scene.height_given && scene.mass_given);
  EXPECT_EQ(scene.subject.lengths.thigh, 0.41);
  EXPECT_EQ(scene.subject.lengths.hip_width, 0.16);
  EXPECT_FALSE(scene.subject.lengths.shank);
  EXPECT_EQ(scene.initial->position, Vector2d(1, 2));
  EXPECT_EQ(scene.initial->time, 0.5);
  EXPECT_NEAR(scene.initial->heading, -0.3, 1e-15);
  EXPECT_EQ(scene.initial->speed, 1.2);
  EXPECT_EQ(scene.initial->phase, 0.25);
  EXPECT_EQ(scene.truth, folder_.path() / "truth.csv");
  EXPECT_EQ(scene.first_frame, 5);
  EXPECT_EQ(scene.last_frame, 9);
}

TEST_F(SceneFile, ThePlaceOfTheSubjectIsOnTheGroundOrInAPicture) {
  const Scene there = read(kCamera + "subject: {near: {time: 1.5, position: [2, -1]}}\n");
  ASSERT_TRUE(there.near);
  EXPECT_EQ(there.near->time, 1.5);
  EXPECT_EQ(there.near->position, Vector2d(2, -1));
  EXPECT_FALSE(there.height_given);
  const auto pixel = project(there.cameras[0].camera, Vector3d(0.3, 0.5, 0));
  ASSERT_TRUE(pixel);
  const Scene seen = read(kCamera + fmt::format("subject: {{near: {{time: 0, camera: a, feet_px: "
                                                "[{:.6f}, {:.6f}]}}}}\n",
                                                pixel->x(), pixel->y()));
  EXPECT_LT((seen.near->position - Vector2d(0.3, 0.5)).norm(), 1e-4);
  EXPECT_FALSE(read(kCamera).near);
}

TEST_F(SceneFile, ThePlaceOfTheSubjectHasToBeOne) {
  const auto message = [&](const std::string& near) {
    return message_for(kCamera + "subject: {near: " + near + "}\n");
  };
  EXPECT_THAT(message("{position: [2, -1]}"), HasSubstr("time"));
  EXPECT_THAT(message("{time: 1}"), HasSubstr("neither 'position' nor 'feet_px'"));
  EXPECT_THAT(message("{time: 1, feet_px: [3, 4]}"), HasSubstr("camera"));
  EXPECT_THAT(message("{time: 1, camera: b, feet_px: [3, 4]}"), HasSubstr("the name of a camera"));
  EXPECT_THAT(message("{time: 1, camera: a, feet_px: [30, 2]}"),
              HasSubstr("a pixel in which the camera sees the ground"));
  for (const char* pixel : {"[30, 49]", "[-1, 40]", "[65, 40]"})
    EXPECT_THAT(message(fmt::format("{{time: 1, camera: a, feet_px: {}}}", pixel)),
                HasSubstr("allowed: a pixel of its pictures, 64 x 48"));
  EXPECT_THAT(message("{time: 1, position: [2, -1], feet_px: [3, 4]}"), HasSubstr("one of them"));
  EXPECT_THAT(message("{time: 1, position: [2, -1]}}\ninitial: {position: [0, 0], heading: 0"),
              HasSubstr("one of them"));
  folder_.write("anna.yaml", "height: 1.7\nnear: {time: 1, position: [2, -1]}");
  EXPECT_THAT(message_for(kCamera + "subject: anna.yaml\n"), HasSubstr("anna.yaml"));
}

TEST_F(SceneFile, OccludersMayComeAndGo) {
  const Scene scene = read(kCamera +
                           "occluders:\n  a:\n    - [[0, 0], [1, 0], [1, 1]]\n"
                           "    - {polygon: [[5, 0], [6, 0], [6, 1]], from: 1, to: 1.5}\n"
                           "    - {polygon: [[7, 0], [8, 0], [8, 1]], to: 1}\n");
  const auto first_corners = [&](double time) {
    std::vector<double> out;
    for (const Polygon& polygon : occluders_at(scene.cameras[0], time))
      out.push_back(polygon[0].x());
    return out;
  };
  EXPECT_THAT(first_corners(0), testing::ElementsAre(0, 7));
  EXPECT_THAT(first_corners(1), testing::ElementsAre(0, 5, 7));
  EXPECT_THAT(first_corners(1.5), testing::ElementsAre(0, 5));
  EXPECT_THAT(first_corners(1.51), testing::ElementsAre(0));
}

TEST_F(SceneFile, TurnsCalibrationAxesIntoTheWorld) {
  // y up: world = (x, -z, y). The camera's centre (0, -5, 1) of the file is 4.8 m below the ground.
  const Scene scene = read(kCamera +
                           "ground: {normal: [0, 1, 0], offset: -0.2}\n"
                           "gravity: [0, -9.81, 0]\n"
                           "initial: {position: [3, -0.2, 7], heading: [0, 0, 2]}\n");
  EXPECT_LT((camera_centre(scene.cameras[0].camera) - Vector3d(0, -1, -4.8)).norm(), 1e-12);
  EXPECT_LT((scene.gravity - Vector3d(0, 0, -9.81)).norm(), 1e-12);
  EXPECT_LT((scene.initial->position - Vector2d(3, -7)).norm(), 1e-12);
  EXPECT_NEAR(scene.initial->heading, -kPi / 2, 1e-12);
}

TEST_F(SceneFile, LiftsPositionsOntoATiltedGround) {
  const Scene scene = read(kCamera +
                           "ground: {normal: [0.1, 0, 1], offset: 0}\n"
                           "initial: {position: [2, 0], heading: 0}\n");
  // (2, 0, -0.2) is on the plane, |(2, 0, -0.2)| from the origin along the ground.
  EXPECT_LT((scene.initial->position - Vector2d(std::hypot(2, 0.2), 0)).norm(), 1e-12);
}

TEST_F(SceneFile, IsNoVideo) {
  EXPECT_THAT(message_of<InputError>([&] { read_scene(folder_.path() / "a.mp4"); }),
              testing::AllOf(HasSubstr("a.mp4: found a video, allowed: a scene"),
                             HasSubstr("'walktrack init'")));
}

TEST_F(SceneFile, NamesPlaceFoundAndAllowed) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "cameras: found nothing"},
      {"cameras: []\n", ":1: cameras: found an empty list, allowed: at least one camera"},
      {"cameras: a\n", ":1: cameras: found 'a', allowed: a list"},
      {kCamera + "subjekt: {}\n", ":3: subjekt: found an unknown key, did you mean 'subject'?"},
      {kCamera + "subject: {hight: 1.7}\n", "found an unknown key, did you mean 'height'?"},
      {kCamera + "subject: {height: 175}\n",
       ":3: subject.height: found '175', allowed: a number from 0.2 to 4"},
      {kCamera + "subject: {lengths: {thigh: 0.4 m}}\n", "subject.lengths.thigh: found '0.4 m'"},
      {kCamera + "frame_rate: 0\n", "frame_rate: found '0', allowed: a number from 0.1 to 1000"},
      {kCamera + "first_frame: 5\nlast_frame: 4\n", "last_frame: found '4', allowed: a whole"},
      {kCamera + "ground: {normal: [0, 0, 0]}\n", "ground.normal: found no direction"},
      {kCamera + "gravity: [0, 0, 9.81]\n", "gravity 180 degrees off the ground's downward"},
      {kCamera + "gravity: [0, 0, -9806]\n", "gravity: found 9806 m/s^2"},
      {kCamera + "initial: {position: [1, 2]}\n", "initial.heading: found nothing"},
      {kCamera + "initial: {position: [1], heading: 0}\n", "initial.position: found 1 numbers"},
      {kCamera + "initial: {position: [1, 2], heading: [0, 0, 1]}\n", "along the ground"},
      {kCamera + "initial: {position: [1, 2], heading: 0, phase: 2}\n", "initial.phase: found '2'"},
      {kCamera + "ground: {normal: [0, 1, 0]}\ninitial: {position: [1, 2], heading: 0}\n",
       "initial.position: found 2 numbers, allowed: [x, y, z], for z is not up"},
      {kCamera + "occluders: {b: []}\n", "occluders.b: found an unknown key"},
      {kCamera + "occluders: {a: [[[0, 0], [1, 1]]]}\n", "occluders.a[0]: found 2 corners"},
      {kCamera + "occluders: {a: [{from: 1}]}\n", "occluders.a[0].polygon: found nothing"},
      {kCamera + "occluders: {a: [{polygon: [[0, 0], [9, 0], [9, 9]], from: 2, to: 1}]}\n",
       "occluders.a[0].to: found '1', allowed: a number from 2"},
      {kCamera + "truth: none.csv\n", "truth: found 'none.csv', allowed: a file that exists"},
      {replaced(kCamera, "a.mp4", "b.mp4"), ":2: cameras[0].video: found 'b.mp4'"},
      {replaced(kCamera, "name: a", "name: a/b"), "cameras[0].name: found 'a/b'"},
      {replaced(kCamera, "name: a, ", ""), ":2: cameras[0].name: found nothing"},
      {kCamera + replaced(kCamera, "cameras:\n", ""), ":3: cameras[1].name: found 'a' twice"},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_THAT(message_for(text), HasSubstr(expected)) << text;
  }
}

TEST_F(SceneFile, PassesOnWhatIsWrongWithACalibration) {
  folder_.write("a.yaml", replaced(kCalibrationText, "image_height: 48", "image_height: -1"));
  EXPECT_THAT(message_for(kCamera), HasSubstr("a.yaml:4: image_height: found '-1'"));
}

TEST(SharedScenes, AllRead) {
  const std::string root = shared_data("");
  if (!std::filesystem::exists(root)) GTEST_SKIP() << "no " << root;
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("scene") && !name.starts_with("walker")) continue;
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_NO_THROW(read_scene(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 1);
}

}  // namespace
}  // namespace walktrack
