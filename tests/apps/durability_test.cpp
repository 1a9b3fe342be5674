// The batch under adverse conditions: killed at any moment, interrupted, without space, without
// permission, and with sequences that are broken in every way. With WALKTRACK_SLOW set, at the
// scale that is promised.
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data_folders.h"
#include "tests/run_program.h"
#include "tests/sanitized.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;
using testing::HasSubstr;

bool slow() { return std::getenv("WALKTRACK_SLOW") != nullptr; }

std::string numbered(int i) { return std::string("s").append(std::to_string(i)); }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("'" + from + "' is not in the text");
  return text.replace(at, from.size(), to);
}

// A folder with sequences of a walk of 0.8 s, 96 x 72 pixels, that differ in their last frames.
class Durability : public testing::Test {
 protected:
  Durability() {
    const std::string options = folder_.write("walk.yaml",
                                              "frame_rate: 15\nduration: 0.8\ninitial: true\n"
                                              "background_frames: 5\n"
                                              "walk: {speed: 1.2, start: [-0.5, 0]}\n"
                                              "cameras: [{name: side, azimuth_deg: -90, "
                                              "distance: 4, size: [96, 72]}]\n");
    const ProgramResult render =
        run_walktrack({"render", "--options", options, "-o", folder_ / "walk"});
    if (render.exit_code != 0) throw std::runtime_error(render.err);
    scene_ = read_file(folder_ / "walk/scene.yaml");
  }

  void add_sequences(int count) const {
    for (int i = 0; i < count; ++i) {
      const fs::path to = in() / numbered(i);
      fs::create_directories(to);
      fs::copy(folder_ / "walk", to, fs::copy_options::recursive);
      write(i, "scene.yaml", scene_ + "last_frame: " + std::to_string(6 + i % 6) + "\n");
    }
  }
  void write(int sequence, const std::string& file, const std::string& content) const {
    folder_.write("in/" + numbered(sequence) + "/" + file, content);
  }

  fs::path in() const { return folder_.path() / "in"; }
  std::vector<std::string> batch(const std::string& out) const {
    return {"batch", in().string(), "-o", folder_ / out, "--jobs", "2", "--threads", "1", "--set",
            "filter.particles=20", "--set", "start.particles=10",
            // Half a second of walking need not contain a step.
            "-c", kAnyQuality,
            // A process that is killed during tracking, which begins soon, leaves a checkpoint.
            "--set", "checkpoint.seconds=0", "--set", "start.seconds=0.1"};
  }

  // What must not depend on the time of the batch: all files except logs, times and files that
  // contain times.
  std::map<std::string, std::string> results(const std::string& out) const {
    std::map<std::string, std::string> found;
    if (!fs::exists(folder_.path() / out)) return found;  // killed before it did anything
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path() / out)) {
      const std::string name = entry.path().filename().string();
      if (!entry.is_regular_file() || name == "log.txt" || name.ends_with(".html")) continue;
      std::string content = read_file(entry.path());
      if (name == "run.json") content = line_with(content, "\"digest\"");
      if (name == "summary.csv") content = without_seconds(content);
      found[entry.path().lexically_relative(folder_.path() / out).string()] = content;
    }
    return found;
  }
  static std::string line_with(const std::string& text, const std::string& word) {
    const size_t at = text.find(word);
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
  }
  static std::string without_seconds(const std::string& table) {
    std::istringstream lines(table);
    std::string kept, line;
    while (std::getline(lines, line)) {
      const size_t second = line.find(',', line.find(',') + 1);
      const std::string rest = line.substr(line.find(',', second + 1));
      kept += line.substr(0, second) + rest.substr(0, rest.rfind(',')) + "\n";
    }
    return kept;
  }
  // Sequences with a run.json have the right bytes, whatever happened to the batch.
  void expect_complete_ones_sound(const std::string& out,
                                  const std::map<std::string, std::string>& sound) const {
    const auto found = results(out);
    for (const auto& [name, content] : found) {
      const std::string sequence = name.substr(0, name.find('/'));
      if (!found.contains(sequence + "/run.json")) continue;
      const auto wanted = sound.find(name);
      if (wanted != sound.end()) {
        EXPECT_EQ(content, wanted->second) << name;
      }
    }
  }

  // Kills batches with these options at any moment, and runs them again.
  void expect_same_bytes_after_kills(const std::vector<std::string>& options) {
    add_sequences(3);
    const auto start = Clock::now();
    ASSERT_EQ(run_walktrack(batch("undisturbed")).exit_code, 0);
    const std::chrono::duration<double> whole = Clock::now() - start;
    const auto sound = results("undisturbed");
    ASSERT_TRUE(sound.contains("s2/overlay_side.mp4"));
    std::mt19937 random(9);
    int unfinished = 0;
    const int kills = slow() ? 50 : 1;
    for (int kill = 0; kill < kills; ++kill) {
      const std::string out = "killed" + std::to_string(kill);
      std::vector<std::string> again = batch(out);
      again.insert(again.end(), options.begin(), options.end());
      {
        StartedProgram program(WALKTRACK_BINARY, again);
        // Waits for up to the expected duration.
        std::this_thread::sleep_for(whole * (static_cast<double>(random()) / std::mt19937::max()));
        program.send(SIGKILL);
        unfinished += program.wait() == 128 + SIGKILL;
      }
      expect_complete_ones_sound(out, sound);
      if (!options.empty()) expect_whole_ones_only(out);
      again.emplace_back("--resume");
      const ProgramResult resumed = run_walktrack(again);
      EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
      const auto found = results(out);
      for (const auto& [name, content] : sound) {
        const auto same = found.find(name);
        EXPECT_TRUE(same != found.end() && same->second == content) << name << ", kill " << kill;
      }
      for (const auto& each : found)
        EXPECT_TRUE(sound.contains(each.first)) << each.first << ", kill " << kill;
      fs::remove_all(folder_.path() / out);
    }
    // Otherwise the test has killed little; on a busy machine the first run takes longer than
    // others.
    EXPECT_GE(unfinished, kills / 4);
  }
  // With a work folder a sequence has either all its files or none.
  void expect_whole_ones_only(const std::string& out) const {
    for (int i = 0; i < 3; ++i) {
      const fs::path place = folder_.path() / out / numbered(i);
      EXPECT_EQ(fs::exists(place), fs::exists(place / "run.json")) << i;
    }
  }

  TemporaryFolder folder_;
  std::string scene_;
};

TEST_F(Durability, KilledAtAnyMomentItResumesToTheSameBytes) { expect_same_bytes_after_kills({}); }

TEST_F(Durability, KilledWithAWorkFolderItShowsWholeResultsAndResumes) {
  expect_same_bytes_after_kills({"--work", folder_ / "work"});
}

TEST_F(Durability, StopsWhenToldAndGoesOnLater) {
  add_sequences(4);
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string out = "stopped" + std::to_string(signal);
    StartedProgram program(WALKTRACK_BINARY, batch(out));
    while (!fs::exists(folder_.path() / out / "s0/log.txt")) std::this_thread::yield();
    program.send(signal);
    EXPECT_EQ(program.wait(), 130);
    for (int i = 0; i < 4; ++i) {
      EXPECT_FALSE(fs::exists(folder_.path() / out / (".walktrack_for." + numbered(i)))) << i;
      EXPECT_FALSE(fs::exists(folder_.path() / out / numbered(i) / "failure.txt")) << i;
    }
    EXPECT_EQ(run_walktrack(batch(out)).exit_code, 0);
  }
  EXPECT_EQ(results("stopped2"), results("stopped15"));
}

// A limit on the size of files makes writes fail like a full disk, at any place.
TEST_F(Durability, WithoutSpaceNothingHalfWrittenIsTakenForComplete) {
  add_sequences(1);
  const std::string shell =
      "ulimit -f $1; trap '' XFSZ; shift; exec \"$@\"";  // blocks of 512 bytes
  std::vector<std::string> track{
      "track", (in() / "s0/scene.yaml").string(), "--set", "filter.particles=20", "-c", kAnyQuality,
      "-o"};
  track.push_back(folder_ / "enough/s0");
  ASSERT_EQ(run_walktrack(track).exit_code, 0);
  const auto sound = results("enough");
  int failed = 0;
  for (const int blocks : {0, 6, 10'000}) {
    fs::remove_all(folder_.path() / "full");
    track.back() = folder_ / "full/s0";
    std::vector<std::string> words{"-c", shell, "sh", std::to_string(blocks), WALKTRACK_BINARY};
    words.insert(words.end(), track.begin(), track.end());
    const ProgramResult run = run_program("/bin/sh", words);
    const bool complete = fs::exists(folder_.path() / "full/s0/run.json");
    EXPECT_EQ(run.exit_code, complete ? 0 : 1) << blocks << run.err;
    failed += !complete;
    if (!complete) {  // there is space again
      track.push_back("--resume");
      EXPECT_EQ(run_walktrack(track).exit_code, 0);
      track.pop_back();
    }
    EXPECT_EQ(results("full"), sound) << blocks;
  }
  EXPECT_EQ(failed, 2);
}

TEST_F(Durability, SaysWhereItMayNotWrite) {
  add_sequences(1);
  // Not even root can create folders there.
  const ProgramResult run =
      run_walktrack({"track", (in() / "s0/scene.yaml").string(), "-o", "/proc/walktrack"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("/proc/walktrack"));
}

// Faults of recordings and scenes, each planted into the sequence with its number.
using Plant = void (*)(const fs::path& sequence, const std::string& scene);

void put(const fs::path& file, const std::string& content) {
  std::ofstream(file, std::ios::binary) << content;
}

const std::vector<Plant>& faults() {
  static const std::vector<Plant> kFaults{
      [](const fs::path& s, const std::string&) { put(s / "scene.yaml", "cameras: ["); },
      [](const fs::path& s, const std::string&) { put(s / "scene.yaml", ""); },
      [](const fs::path& s, const std::string&) {
        put(s / "scene.yaml", std::string(100'000, '['));
      },
      [](const fs::path& s, const std::string& text) {
        put(s / "scene.yaml", text + "subjekt: {height: 1.7}\n");
      },
      [](const fs::path& s, const std::string& text) {
        put(s / "scene.yaml", replaced(text, "height: 1.75", "height: 175"));
      },
      [](const fs::path& s, const std::string& text) {
        put(s / "scene.yaml", text + "gravity: [0, 0, 9.81]\n");
      },
      [](const fs::path& s, const std::string& text) {
        put(s / "scene.yaml", text + "first_frame: 5000\n");
      },
      [](const fs::path& s, const std::string& text) {
        put(s / "scene.yaml", text + "occluders: {side: [[[0, 0], [1, 1]]]}\n");
      },
      [](const fs::path& s, const std::string& text) {
        put(s / "scene.yaml", replaced(text, "name: side", "name: ../side"));
      },
      [](const fs::path& s, const std::string&) { fs::remove(s / "side.mp4"); },
      [](const fs::path& s, const std::string&) { put(s / "side.mp4", ""); },
      [](const fs::path& s, const std::string&) { put(s / "side.mp4", "no video at all"); },
      [](const fs::path& s, const std::string&) {  // truncated in the middle: no index
        fs::resize_file(s / "side.mp4", fs::file_size(s / "side.mp4") / 2);
      },
      [](const fs::path& s, const std::string&) {  // a folder without images
        fs::remove(s / "side.mp4");
        fs::create_directory(s / "side.mp4");
      },
      [](const fs::path& s, const std::string&) { fs::remove(s / "side.yaml"); },
      [](const fs::path& s, const std::string&) { put(s / "side.yaml", "image_width: 96\n"); },
      [](const fs::path& s, const std::string&) {
        const std::string text = read_file(s / "side.yaml");
        put(s / "side.yaml", replaced(text, "image_width: 96", "image_width: 97"));
      },
      [](const fs::path& s, const std::string&) {
        const std::string text = read_file(s / "side.yaml");
        put(s / "side.yaml", replaced(text, "image_width: 96", "image_width: .nan"));
      },
      [](const fs::path& s, const std::string&) { put(s / "side_background.mp4", "no video"); },
      [](const fs::path& s, const std::string&) {  // images of different sizes
        fs::remove(s / "side.mp4");
        fs::create_directory(s / "side.mp4");
        std::string large = "P6 96 72 255\n", small = "P6 96 71 255\n";
        put(s / "side.mp4/1.ppm", large.append(96 * 72 * 3, 'x'));
        put(s / "side.mp4/2.ppm", small.append(96 * 71 * 3, 'x'));
      },
  };
  return kFaults;
}

TEST_F(Durability, BrokenSequencesCostOneRowEach) {
  const int kinds = static_cast<int>(faults().size());
  const int count = slow() ? 10 * kinds : kinds + 2;
  add_sequences(count);
  for (int i = 0; i < kinds; ++i) {
    const int sequence = slow() ? 10 * i : i;
    faults()[static_cast<size_t>(i)](in() / numbered(sequence), scene_);
  }
  StartedProgram program(WALKTRACK_BINARY, batch("out"));
  EXPECT_EQ(program.wait(), 1);
  std::istringstream summary(read_file(folder_ / "out/summary.csv"));
  int complete = 0, failed = 0;
  for (std::string line; std::getline(summary, line);) {
    complete += line.find(",complete,") != std::string::npos;
    failed += line.find(",failed,") != std::string::npos;
  }
  EXPECT_EQ(complete, count - kinds);
  EXPECT_EQ(failed, kinds);
  std::istringstream reasons(read_file(folder_ / "out/failures.txt"));
  int named = 0;
  for (std::string line; std::getline(reasons, line);) {
    ++named;
    EXPECT_THAT(line, HasSubstr(": exit 3: ")) << "a reason of the input's";
  }
  EXPECT_EQ(named, kinds);
  EXPECT_THAT(read_file(folder_ / "out/failures.txt"), HasSubstr("frame 1 is 96x71 px"));
  RecordProperty("peak_memory_mb", static_cast<int>(program.peak_memory()));
  // The largest process is one that tracks 96 x 72 pixels, not a growing batch.
  if (!kSanitized) {
    EXPECT_LT(program.peak_memory(), 200);
  }
}

}  // namespace
}  // namespace walktrack
