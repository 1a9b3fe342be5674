// Videos that are shorter than the window in which a walk is searched, and messages for videos in
// which nobody is found.
#include <chrono>
#include <filesystem>
#include <iomanip>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/data_folders.h"
#include "tests/io/sample_files.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

using testing::HasSubstr;

class ShortVideo : public testing::Test {
 protected:
  ProgramResult track(const std::string& scene) const {
    return run_walktrack({"track", scene, "-o", folder_ / "out", "-y", "--no-overlay", "--set",
                          "filter.particles=100"});
  }
  // The first frames of the demo, or its empty room.
  std::string demo(int frames, const std::string& video = "") const {
    std::string text =
        "frame_rate: 30\nsubject: {height: 1.75}\nlast_frame: " + std::to_string(frames - 1) +
        "\ncameras:\n";
    for (const std::string name : {"side", "front"}) {
      const std::string place = (kDemo / name).string();
      text.append("  - {name: ").append(name).append(", video: ").append(place).append(video);
      text.append(".mp4, background: ").append(place).append("_background.mp4, calibration: ");
      text.append(place).append(".yaml}\n");
    }
    return folder_.write("demo.yaml", text);
  }
  // One camera's view of a motion, 2 s.
  std::string filmed(const std::string& motion, double distance) const {
    const std::string options =
        folder_.write("video.yaml",
                      "frame_rate: 30\nduration: 2\nbackground_frames: 10\ncameras:\n"
                      "  - {name: side, azimuth_deg: -90, height: 1.2, focal_px: 300, size: [320, "
                      "240], distance: " +
                          std::to_string(distance) + "}\n");
    const ProgramResult made =
        run_walktrack({"render", motion, "--options", options, "-o", folder_ / "video"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return folder_ / "video/scene.yaml";
  }
  nlohmann::json numbers() const {
    return nlohmann::json::parse(read_file(folder_ / "out/run.json")).at("numbers");
  }
  TemporaryFolder folder_;
};

TEST_F(ShortVideo, IsSearchedFromHalfASecondOn) {
  for (const int frames : {18, 30}) {  // 0.6 and 1 s
    const ProgramResult result = track(demo(frames));
    EXPECT_THAT(result.err, testing::Not(HasSubstr("nobody"))) << frames << ": " << result.err;
    EXPECT_GE(numbers().at("tracked_frames"), frames - 6);
  }
}

// The speed is the number of frames over the time of the whole command, the same in the terminal
// and in the files.
TEST_F(ShortVideo, StatesOneSpeedAndThatInTheStride) {
  constexpr int kFrames = 50;  // longer than the search window, so that some are followed
  const auto start = std::chrono::steady_clock::now();
  const ProgramResult result = track(demo(kFrames));
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  const std::string text = read_file(folder_ / "out/run.json");
  const nlohmann::json timing = nlohmann::json::parse(text).at("timing");
  const double speed = timing.at("frames_per_second");
  const double stride = timing.at("stride_frames_per_second");
  EXPECT_NEAR(speed, kFrames / timing.at("seconds").get<double>(), 1e-9);
  EXPECT_GE(speed, kFrames / passed.count());
  EXPECT_GT(stride, speed);
  std::ostringstream words;
  words << std::fixed << std::setprecision(1) << speed << " frames/s (" << stride
        << " while tracking)\n";
  EXPECT_THAT(result.err, HasSubstr(words.str()));
  EXPECT_THAT(read_file(folder_ / "out/report.html"),
              HasSubstr("\"frames_per_second\":" + timing.at("frames_per_second").dump()));
}

TEST_F(ShortVideo, OfAnEmptyRoomStatesNoSpeedInTheStride) {
  const ProgramResult result = track(demo(20, "_background"));
  const nlohmann::json run = nlohmann::json::parse(read_file(folder_ / "out/run.json"));
  EXPECT_TRUE(run.at("timing").at("stride_frames_per_second").is_null());
  EXPECT_THAT(result.err,
              testing::ContainsRegex("0 of 20 frames tracked, [0-9.]+ frames/s\n  open"));
}

TEST_F(ShortVideo, OfLessThanThatSaysSo) {
  const ProgramResult result = track(demo(12));
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.err, HasSubstr("nobody was found walking: the video lasts 0.40 s, a walk "
                                    "takes at least 0.5 s to be found"));
}

TEST_F(ShortVideo, OfAnEmptyRoomSaysThatNobodyStandsOut) {
  const ProgramResult result = track(demo(20, "_background"));
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.err, HasSubstr("no person stands out from the background"));
}

TEST_F(ShortVideo, OfSomebodyFarAwaySaysHowSmall) {
  const ProgramResult result = track(filmed(kDemo / "truth.csv", 22));
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_THAT(result.err, testing::ContainsRegex("2[4-9] px high, at least 24 px are needed"));
}

// A person who stands still in the middle of a step.
TEST_F(ShortVideo, OfSomebodyWhoStandsIsNoWalk) {
  std::istringstream truth(read_file(kDemo / "truth.csv"));
  std::string header, row;
  while (std::getline(truth, header) && header.starts_with("#")) {
  }
  for (int i = 0; i < 60; ++i) std::getline(truth, row);  // in the middle of the walk
  std::string standing = header + "\n";
  for (int i = 0; i <= 60; ++i)
    standing += std::to_string(i / 30.0) + row.substr(row.find(',')) + "\n";
  const ProgramResult result = track(filmed(folder_.write("standing.csv", standing), 5));
  EXPECT_EQ(result.exit_code, 4) << result.err;
}

}  // namespace
}  // namespace walktrack
