// A command that is run again with another configuration or other inputs does not take the old
// result for the new one: it states the differences, and computes the result again with -y.
#include <filesystem>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data_folders.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kWalk =
    "frame_rate: 10\nduration: 0.3\ninitial: true\nbackground_frames: 2\nsensor: {noise: 0.01}\n"
    "walk: {speed: 1.2, start: [-0.2, 0]}\n"
    "cameras: [{name: side, azimuth_deg: -90, distance: 4, size: [64, 48]}]\n";

constexpr const char* kFast = WALKTRACK_SOURCE_DIR "/configs/fast.yaml";

class Changes : public testing::Test {
 protected:
  using Words = std::vector<std::string>;

  Changes() { record("in/a", 1), record("in/b", 2); }

  // Another seed gives other noise in the images.
  void record(const std::string& name, int seed) const {
    const std::string options = folder_.write("walk.yaml", kWalk);
    const ProgramResult made = run_walktrack({"render", "--options", options, "--seed",
                                              std::to_string(seed), "-o", folder_ / name, "-y"});
    if (made.exit_code != 0) throw std::runtime_error(made.err);
  }
  ProgramResult run(Words words, const Words& more) const {
    words.insert(words.end(), {"--threads", "1", "-c", config_, "--set", "filter.particles=5",
                               "--set", "start.particles=5"});
    words.insert(words.end(), more.begin(), more.end());
    return run_walktrack(words);
  }
  ProgramResult track(const Words& more = {}) const {
    return run({"track", folder_ / "in/a/scene.yaml", "-o", folder_ / "a"}, more);
  }
  ProgramResult batch(const Words& more = {}) const {
    return run({"batch", folder_ / "in", "-o", folder_ / "out"}, more);
  }
  void append(const std::string& file, const std::string& text) const {
    folder_.write(file, read_file(folder_ / file) + text);
  }
  std::string joints(const std::string& of) const {
    return read_file(folder_ / (of + "/joints.csv"));
  }
  std::string record(const std::string& of) const {
    return read_file(folder_ / (of + "/run.json"));
  }

  const TemporaryFolder folder_;
  std::string config_ = kAnyQuality;
};

TEST_F(Changes, ATrackSaysWhatHasChanged) {
  ASSERT_EQ(track().exit_code, 0);
  const std::string first = record("a");
  const auto refused = [&](const Words& more, const std::string& words) {
    const ProgramResult again = track(more);
    EXPECT_EQ(again.exit_code, 2);
    EXPECT_THAT(again.err, AllOf(HasSubstr(words), HasSubstr("-y makes it again")));
    EXPECT_EQ(record("a"), first);
  };
  refused({}, "a complete result of these very settings and inputs; -y");
  refused({"--seed", "2"}, "(seed 1 -> 2)");
  config_ = folder_.write("fast.yaml", read_file(kAnyQuality) + "\n" + read_file(kFast));
  refused({}, "(filter.moves 4 -> 2)");
  config_ = kAnyQuality;
  append("in/a/side.yaml", "# measured again\n");
  refused({}, "(side.yaml has changed)");
  record("in/a", 3);
  refused({}, "side.mp4 has changed");
  const ProgramResult done = track({"-y"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_THAT(done.err,
              HasSubstr("made again, because it was made with other settings or inputs (side.mp4"));
  EXPECT_NE(record("a"), first);
  EXPECT_THAT(track().err, HasSubstr("these very settings and inputs"));
}

TEST_F(Changes, AnotherProgramVersionIsStated) {
  ASSERT_EQ(track().exit_code, 0);
  std::string text = record("a");
  const size_t at = text.find("\"version\": \"") + 12;
  folder_.write("a/run.json", text.replace(at, 1, "older "));
  EXPECT_THAT(track().err, HasSubstr("(version of the program older "));
}

// Complete results of other settings are kept, the rest is tracked; the difference is stated once,
// with its cause.
TEST_F(Changes, ABatchKeepsNamesAndDoesTheRest) {
  ASSERT_EQ(batch().exit_code, 0);
  const std::string a = record("out/a"), b = record("out/b");
  record("in/c", 4);
  const ProgramResult preset = batch({"--seed", "2"});
  EXPECT_EQ(preset.exit_code, 2);
  EXPECT_THAT(preset.err, AllOf(HasSubstr("3 complete, 0 degraded, 0 failed, 0 left"),
                                HasSubstr("2 sequences are left as they are"),
                                HasSubstr("\n  seed 1 -> 2: a, b\n"), HasSubstr("-y tracks them")));
  EXPECT_EQ(record("out/a"), a);
  EXPECT_THAT(record("out/c"), HasSubstr("\"seed\": 2"));
  EXPECT_EQ(batch({"--seed", "2", "-y"}).exit_code, 0);
  EXPECT_NE(record("out/a"), a);
  EXPECT_EQ(batch({"--seed", "2"}).exit_code, 0);
}

TEST_F(Changes, ABatchDoesAgainWhatHasChangedAndNothingElse) {
  ASSERT_EQ(batch().exit_code, 0);
  const std::string a = record("out/a"), b = record("out/b");
  const auto made = fs::last_write_time(folder_.path() / "out/b/run.json");
  record("in/a", 3);
  EXPECT_EQ(batch({"-y", "--dry-run"}).out, "a\n");
  EXPECT_EQ(batch({"-y"}).exit_code, 0);
  EXPECT_NE(record("out/a"), a);
  EXPECT_EQ(record("out/b"), b);
  EXPECT_EQ(fs::last_write_time(folder_.path() / "out/b/run.json"), made);
}

TEST_F(Changes, ABatchSeesAnotherVideoAndAnotherCalibration) {
  ASSERT_EQ(batch().exit_code, 0);
  const std::string a = joints("out/a");
  record("in/a", 3);
  append("in/b/side.yaml", "# measured again\n");
  const ProgramResult again = batch();
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, AllOf(HasSubstr("side.mp4 has changed"), HasSubstr(": a\n"),
                               HasSubstr("\n  side.yaml has changed: b\n")));
  EXPECT_EQ(joints("out/a"), a);
  // A changed video is also detected if its size and time are the same, by its content.
  EXPECT_EQ(batch({"-y"}).exit_code, 0);
  const fs::path video = folder_.path() / "in/a/side_background.mp4";
  const auto time = fs::last_write_time(video);
  std::string bytes = read_file(video);
  bytes[bytes.size() / 2] ^= 1;
  folder_.write("in/a/side_background.mp4", bytes);
  fs::last_write_time(video, time);
  EXPECT_THAT(batch().err, HasSubstr("\n  side_background.mp4 has changed: a\n"));
}

TEST_F(Changes, ABatchOfVideosSeesAnotherTemplate) {
  fs::create_directory(folder_.path() / "videos");
  fs::copy(folder_.path() / "in/a/side.mp4", folder_.path() / "videos/a.mp4");
  folder_.write("in/a/room.yaml",
                "cameras: [{name: side, video: side.mp4, calibration: side.yaml, "
                "background: side_background.mp4}]\nsubject: {height: 1.75}\n");
  const Words words{"batch", folder_ / "videos", "--scene", folder_ / "in/a/room.yaml",
                    "-o",    folder_ / "out"};
  EXPECT_THAT(run(words, {}).exit_code, AnyOf(0, 4));
  EXPECT_THAT(run(words, {}).err, Not(HasSubstr("left as they are")));
  append("in/a/room.yaml", "frame_rate: 10\n");
  const ProgramResult again = run(words, {});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("\n  room.yaml has changed: a\n"));
  EXPECT_THAT(run(words, {"-y"}).exit_code, AnyOf(0, 4));
  EXPECT_THAT(run(words, {}).exit_code, AnyOf(0, 4));
}

// A result that was to be made again and failed is no success, although the earlier result still
// exists.
TEST_F(Changes, ABatchSaysThatRemakingFailed) {
  ASSERT_THAT(batch().exit_code, AnyOf(0, 4));
  const std::string kept = record("out/a");
  std::string scene = read_file(folder_ / "in/a/scene.yaml");
  const std::string said = "frame_rate: 10";
  scene.replace(scene.find(said), said.size(), "frame_rate: 20");
  folder_.write("in/a/scene.yaml", scene);
  EXPECT_EQ(batch({"-y"}).exit_code, 1);
  EXPECT_EQ(record("out/a"), kept);
}

TEST_F(Changes, ASweepSeesAnotherVideo) {
  const Words words{
      "sweep", folder_ / "in/a/scene.yaml", "-o", folder_ / "swept", "--over", "moves=1", "--seeds",
      "1"};
  ASSERT_EQ(run(words, {}).exit_code, 0);
  ASSERT_EQ(run(words, {}).exit_code, 0);
  record("in/a", 3);
  const ProgramResult again = run(words, {});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("side.mp4 has changed"));
}

}  // namespace
}  // namespace walktrack
