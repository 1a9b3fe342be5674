#include "io/scene/scene_template.h"

#include <gtest/gtest.h>

#include "core/errors.h"
#include "io/scene/scene.h"
#include "tests/io/sample_files.h"

namespace walktrack {
namespace {

TEST(SceneForVideo, KeepsAllButTheVideoAndReadsFromAnywhere) {
  const TemporaryFolder room, videos;
  room.write("cal.yaml", kCalibrationText);
  room.write("empty.png", "");
  room.write("a.mp4", "");
  room.write("truth.csv", "");
  const std::string video = videos.write("one \"two\": three.mp4", "");
  const std::string scene_template = room.write(
      "scene.yaml",
      "cameras: [{name: a, video: a.mp4, calibration: cal.yaml, background: empty.png}]\n"
      "frame_rate: 50\nsubject: {height: 1.6}\ntruth: truth.csv\n"
      "occluders: {a: [[[0, 0], [1, 0], [1, 1.5]]]}\n");
  const Scene scene =
      read_scene(videos.write("deep/scene.yaml", scene_for_video(scene_template, video)));
  EXPECT_EQ(scene.cameras[0].video, video);
  EXPECT_EQ(scene.cameras[0].calibration, room.path() / "cal.yaml");
  EXPECT_EQ(scene.cameras[0].background, room.path() / "empty.png");
  EXPECT_EQ(scene.frame_rate, 50);
  EXPECT_EQ(scene.subject.height, 1.6);
  EXPECT_EQ(scene.cameras[0].occluders.size(), 1u);
  EXPECT_TRUE(scene.truth.empty());
}

TEST(SceneForVideo, RefusesWhatIsNoSceneOfOneCamera) {
  const TemporaryFolder folder;
  for (const char* text :
       {"cameras: []\n", "cameras: [{}, {}]\n", "cameras: [x]\n", "x: 1\n", "["}) {
    EXPECT_THROW(scene_for_video(folder.write("s.yaml", text), "a.mp4"), InputError) << text;
  }
}

TEST(IsVideoFile, GoesByTheEnding) {
  EXPECT_TRUE(is_video_file("a/b.MP4"));
  EXPECT_TRUE(is_video_file("b.mov"));
  EXPECT_FALSE(is_video_file("b.mp4.txt"));
  EXPECT_FALSE(is_video_file("mp4"));
}

}  // namespace
}  // namespace walktrack
