#include "io/video/scene_video.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/io/sample_files.h"
#include "tests/io/sample_video.h"
#include "tests/message_of.h"

namespace walktrack {
namespace {

using testing::HasSubstr;

// Two cameras of 25 Hz and 20 frames each; `more` adds or replaces keys.
// The number that the camera's picture of this step shows.
int number_in(const SceneVideo& video, size_t camera) {
  cv::Mat picture;
  video.source(camera).picture(picture);
  return shown_number(picture);
}

class SceneVideoTest : public testing::Test {
 protected:
  SceneVideoTest() {
    folder_.write("c.yaml", kCalibrationText);
    write_sample_video(folder_ / "a.mp4", 20);
    write_sample_video(folder_ / "b.mp4", 20);
  }
  SceneVideo open(const std::string& camera_a, const std::string& camera_b,
                  const std::string& more) {
    return SceneVideo(read_scene(folder_.write(
        "scene.yaml", "cameras:\n  - {name: a, video: a.mp4, calibration: c.yaml" + camera_a +
                          "}\n  - {name: b, video: b.mp4, calibration: c.yaml" + camera_b + "}\n" +
                          more)));
  }
  TemporaryFolder folder_;
  SceneFrames frames_;
};

TEST_F(SceneVideoTest, StepsThroughAllCameras) {
  SceneVideo video = open("", "", "");
  EXPECT_EQ(video.frame_rate(), 25);
  EXPECT_EQ(video.frame_count(), 20);
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(video.read(frames_));
    EXPECT_EQ(frames_.number, i);
    EXPECT_NEAR(frames_.time, i / 25.0, 1e-12);
    EXPECT_EQ(number_in(video, 0), i);
    EXPECT_EQ(number_in(video, 1), i);
    EXPECT_TRUE(frames_.fresh[0] && frames_.fresh[1]);
  }
  EXPECT_FALSE(video.read(frames_));
  EXPECT_EQ(video.trouble(), "");
}

// The number by which keypoints are looked up.
TEST_F(SceneVideoTest, SaysWhichFrameOfItsVideoIsShown) {
  SceneVideo video = open(", start_frame: 3", "", "first_frame: 4\n");
  ASSERT_TRUE(video.read(frames_));
  EXPECT_EQ(frames_.source[0], 7);
  EXPECT_EQ(frames_.source[1], 4);
}

TEST_F(SceneVideoTest, TakesNumbersFromTheNamesOfImages) {
  write_sample_images(folder_ / "images", {11, 12, 14});
  SceneVideo video(read_scene(
      folder_.write("images.yaml",
                    "frame_rate: 25\ncameras: [{name: a, video: images, calibration: c.yaml}]\n")));
  std::vector<int> fresh;
  while (video.read(frames_))
    if (frames_.fresh[0]) fresh.push_back(frames_.source[0]);
  EXPECT_THAT(fresh, testing::ElementsAre(11, 12, 14));
}

// Up to the last frame with keypoints.
TEST_F(SceneVideoTest, ShowsPlainPicturesWithoutAVideo) {
  std::string numbers = "10, 10, 0.9";
  for (int i = 1; i < 17; ++i) numbers += ", 10, 10, 0.9";
  folder_.write("points.json", "[{\"image_id\": 6, \"keypoints\": [" + numbers + "]}]");
  SceneVideo video(read_scene(folder_.write(
      "points.yaml",
      "frame_rate: 25\ncameras: [{name: a, keypoints: points.json, calibration: c.yaml}]\n")));
  EXPECT_EQ(video.frame_count(), 7);
  int frames = 0;
  for (; video.read(frames_); ++frames) {
    EXPECT_EQ(frames_.source[0], frames);
    EXPECT_EQ(video.source(0).facts().width_px, 64);
  }
  EXPECT_EQ(frames, 7);
}

TEST_F(SceneVideoTest, HonoursStartFramesAndTheRange) {
  SceneVideo video = open(", start_frame: 3", "", "first_frame: 4\nlast_frame: 6\n");
  EXPECT_EQ(video.frame_count(), 3);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(video.read(frames_));
    EXPECT_EQ(frames_.number, 4 + i);
    EXPECT_NEAR(frames_.time, i / 25.0, 1e-12);
    EXPECT_EQ(number_in(video, 0), 7 + i);
    EXPECT_EQ(number_in(video, 1), 4 + i);
  }
  EXPECT_FALSE(video.read(frames_));
}

TEST_F(SceneVideoTest, EndsWithTheShortestCamera) {
  write_sample_video(folder_ / "b.mp4", 9);
  SceneVideo video = open(", start_frame: 3", "", "");
  EXPECT_EQ(video.frame_count(), 9);
  int count = 0;
  while (video.read(frames_)) ++count;
  EXPECT_EQ(count, 9);
  EXPECT_EQ(video.trouble(), "");
}

TEST_F(SceneVideoTest, MeetsASlowerCameraAtItsNearestFrame) {
  SceneVideo video = open("", ", frame_rate: 10", "frame_rate: 25\nfirst_frame: 1\n");
  // Scene frame n shows b's frame round(0.4 n): 0 1 1 2 2 2 3 ...
  const std::vector<int> shown{0, 1, 1, 2, 2, 2, 3, 3};
  for (size_t i = 0; i < shown.size(); ++i) {
    ASSERT_TRUE(video.read(frames_));
    EXPECT_EQ(number_in(video, 1), shown[i]);
    EXPECT_EQ(frames_.fresh[1], i == 0 || shown[i] != shown[i - 1]);
    EXPECT_TRUE(frames_.fresh[0]);
  }
}

TEST_F(SceneVideoTest, AFasterCameraSkipsFrames) {
  SceneVideo video = open(", frame_rate: 25", ", frame_rate: 50", "frame_rate: 25\n");
  EXPECT_EQ(video.frame_count(), 10);
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(video.read(frames_));
    EXPECT_EQ(number_in(video, 1), 2 * i);
  }
  EXPECT_FALSE(video.read(frames_));
}

// Camera b drops two frames after its fifth.
TEST_F(SceneVideoTest, FramesAfterDroppedOnesKeepTheirTime) {
  std::vector<double> durations(20, 1);
  durations[4] = 3;
  write_uneven_video(folder_ / "b.mp4", durations);
  SceneVideo video = open(", start_frame: 0", "", "frame_rate: 25\n");
  const std::vector<int> shown{0, 1, 2, 3, 4, 4, 4, 5, 6, 7, 8, 9};
  for (size_t i = 0; i < shown.size(); ++i) {
    ASSERT_TRUE(video.read(frames_));
    EXPECT_EQ(number_in(video, 0), static_cast<int>(i));
    EXPECT_EQ(number_in(video, 1), shown[i]) << i;
    EXPECT_EQ(frames_.fresh[1] != 0, i == 0 || shown[i] != shown[i - 1]) << i;
  }
}

// Steps are alternately half longer and half shorter: pairs of frames take as long as two usual
// ones, so that time and count agree over any length.
TEST_F(SceneVideoTest, FramesOfAVaryingRateArePairedByTime) {
  std::vector<double> durations(20, 1);
  for (size_t i = 0; i < 8; ++i) durations[4 + i] = i % 2 == 0 ? 1.5 : 0.5;
  write_uneven_video(folder_ / "b.mp4", durations);
  SceneVideo video = open("", "", "frame_rate: 25\n");
  EXPECT_EQ(video.frame_count(), 20);
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(video.read(frames_));
    EXPECT_EQ(number_in(video, 1), i);
    EXPECT_TRUE(frames_.fresh[1]);
  }
  EXPECT_FALSE(video.read(frames_));
}

// A container's own rate is an average: with dropped frames it is not that of the other frames.
TEST_F(SceneVideoTest, TheRateIsThatOfTheFramesThatWereNotDropped) {
  std::vector<double> durations(18, 1);
  durations[9] = 3;
  write_uneven_video(folder_ / "a.mp4", durations);
  SceneVideo video = open("", "", "");
  EXPECT_NEAR(video.frame_rate(), 25, 1e-6);
  EXPECT_EQ(video.frame_count(), 20);
  int fresh = 0;
  while (video.read(frames_)) {
    EXPECT_EQ(number_in(video, 1), frames_.number);
    EXPECT_TRUE(frames_.fresh[1]);
    fresh += frames_.fresh[0];
    if (frames_.fresh[0] && frames_.number > 9) {
      EXPECT_EQ(number_in(video, 0), frames_.number - 2);
    }
  }
  EXPECT_EQ(fresh, 18);
}

// The same for a folder of images, two of which are missing.
TEST_F(SceneVideoTest, ImagesAfterMissingOnesKeepTheirTime) {
  write_sample_images(folder_ / "f", {0, 1, 2, 5, 6, 7});
  SceneVideo video(read_scene(
      folder_.write("scene.yaml",
                    "frame_rate: 25\ncameras:\n  - {name: a, video: a.mp4, calibration: c.yaml}\n"
                    "  - {name: b, video: f, calibration: c.yaml}\n")));
  EXPECT_EQ(video.frame_count(), 8);
  for (const int shown : {0, 1, 2, 2, 2, 5, 6, 7}) {
    ASSERT_TRUE(video.read(frames_));
    EXPECT_EQ(number_in(video, 1), shown);
    EXPECT_EQ(frames_.fresh[1] != 0, shown == frames_.number);
  }
  EXPECT_FALSE(video.read(frames_));
}

TEST_F(SceneVideoTest, StampsOfAFileThatIsWrongAboutItsRateDoNotCount) {
  SceneVideo video = open(", frame_rate: 50", ", frame_rate: 50", "frame_rate: 50\n");
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(video.read(frames_));
    EXPECT_EQ(number_in(video, 1), i);
  }
}

TEST_F(SceneVideoTest, NeedsARateForImages) {
  write_sample_images(folder_ / "frames", {0, 1, 2});
  const std::string scene =
      folder_.write("i.yaml", "cameras:\n  - {name: a, video: frames, calibration: c.yaml}\n");
  try {
    SceneVideo video(read_scene(scene));
    FAIL() << "opened without a rate";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("frame_rate: found nothing, allowed: a rate in Hz"));
  }
}

TEST_F(SceneVideoTest, RefusesARangeBeyondTheEnd) {
  try {
    open("", "", "first_frame: 20\n");
    FAIL() << "opened beyond the end";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("first_frame: found 20, allowed: a frame before"));
  }
}

TEST_F(SceneVideoTest, RefusesACameraThatStartsAfterItsEnd) {
  EXPECT_THAT(message_of([&] { open("", ", start_frame: 20", ""); }),
              HasSubstr("cameras[1].start_frame: found 20, allowed: less than 20, the frames of"));
}

// 20 frames of 25 Hz last .8 s.
TEST_F(SceneVideoTest, RefusesTimesAfterTheEnd) {
  const auto initial = [](const char* time) {
    return fmt::format("initial: {{time: {}, position: [0, 0], heading: 0}}\n", time);
  };
  EXPECT_NO_THROW(open("", "", initial("0.79")));
  EXPECT_THAT(message_of([&] { open("", "", initial("0.8")); }),
              HasSubstr("initial.time: found 0.8 s, allowed: less than 0.80 s"));
  EXPECT_THAT(message_of([&] { open("", "", "first_frame: 10\n" + initial("0.5")); }),
              HasSubstr("less than 0.40 s"));
  EXPECT_THAT(message_of([&] { open("", "", "subject: {near: {time: 99, position: [2, -1]}}\n"); }),
              HasSubstr("subject.near.time: found 99 s, allowed: less than 0.80 s"));
}

TEST_F(SceneVideoTest, PassesOnTroubleOfACamera) {
  write_sample_images(folder_ / "b", {0, 1, 2, 3});
  folder_.write("b/frame2.png", "broken");
  std::filesystem::remove(folder_ / "b.mp4");
  std::filesystem::rename(folder_ / "b", folder_ / "b.mp4");
  SceneVideo video = open("", "", "");
  int count = 0;
  while (video.read(frames_)) ++count;
  EXPECT_EQ(count, 2);
  EXPECT_THAT(video.trouble(), HasSubstr("frame 2: no PNG, JPEG"));
  EXPECT_FALSE(video.read(frames_));
}

TEST_F(SceneVideoTest, ChecksTheSizeAgainstTheCalibration) {
  folder_.write("c.yaml", replaced(kCalibrationText, "image_width: 64", "image_width: 128"));
  EXPECT_THROW(open("", "", ""), InputError);
}

}  // namespace
}  // namespace walktrack
