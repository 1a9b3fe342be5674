#include "io/ffmpeg/frame_stamps.h"

#include <gtest/gtest.h>

#include "tests/io/sample_video.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

TEST(FrameStamps, AreThoseOfTheFramesInTheirOrder) {
  const TemporaryFolder folder;
  write_sample_video(folder / "a.mp4", 20);  // its encoder has frames out of order
  const std::vector<double> stamps = frame_stamps(folder / "a.mp4");
  ASSERT_EQ(stamps.size(), 20u);
  for (size_t i = 0; i < stamps.size(); ++i) EXPECT_NEAR(stamps[i], double(i) / 25, 1e-6);
  const StampSteps steps = steps_of(stamps);
  EXPECT_NEAR(steps.usual, 1.0 / 25, 1e-6);
  EXPECT_EQ(steps.dropped, 0);
  EXPECT_EQ(steps.uneven, 0);
}

TEST(FrameStamps, TellDroppedFramesFromUnevenSteps) {
  const TemporaryFolder folder;
  std::vector<double> durations(30, 1);
  durations[5] = 3;
  durations[20] = 1.5;
  write_uneven_video(folder / "a.mp4", durations);
  const StampSteps steps = steps_of(frame_stamps(folder / "a.mp4"));
  EXPECT_NEAR(steps.usual, 1.0 / 25, 1e-6);
  EXPECT_EQ(steps.dropped, 2);
  EXPECT_EQ(steps.uneven, 1);
}

TEST(FrameStamps, AreNoneWhereThereIsNoVideo) {
  const TemporaryFolder folder;
  write_sample_images(folder / "f", {0, 1, 2});
  EXPECT_TRUE(frame_stamps(folder / "f").empty());
  EXPECT_TRUE(frame_stamps(folder / "f/frame%d.png").empty());
  EXPECT_TRUE(frame_stamps(folder / "nothing.mp4").empty());
  EXPECT_TRUE(frame_stamps(folder.write("text.mp4", "no video")).empty());
  EXPECT_EQ(steps_of({}).usual, 0);
  EXPECT_EQ(steps_of({0, 0, 0, 0}).usual, 0);
}

TEST(FrameStamps, TheContainersRateIsUsedIfMostFramesAgree) {
  VideoFacts facts;
  facts.frame_rate = 29.97;
  EXPECT_EQ(usual_rate(facts, {.usual = 1 / 29.96}), 29.97);
  EXPECT_EQ(usual_rate(facts, {.usual = 1.0 / 25}), 25);
  EXPECT_EQ(usual_rate(facts, {}), 29.97);
}

}  // namespace
}  // namespace walktrack
