// No command removes or overwrites the user's files in any folder, also with -y, and the message
// gives advice.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data_folders.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;

constexpr const char* kWalkAndFilm =
    "frame_rate: 10\nduration: 0.3\ninitial: true\nbackground_frames: 2\n"
    "walk: {speed: 1.2, start: [-0.2, 0]}\n"
    "cameras: [{name: side, azimuth_deg: -90, distance: 4, size: [64, 48]}]\n";

class OwnFiles : public testing::Test {
 protected:
  using Words = std::vector<std::string>;

  OwnFiles() {
    const ProgramResult made = run_walktrack(render(folder_ / "walk"));
    if (made.exit_code != 0) throw std::runtime_error(made.err);
  }
  Words render(const std::string& output) const {
    return {"render", "--options", folder_.write("walk.yaml", kWalkAndFilm), "-o", output};
  }
  Words track(const std::string& scene, const std::string& output) const {
    return {"track",     scene,
            "--threads", "1",
            "--set",     "filter.particles=5",
            "--set",     "start.particles=5",
            "-c",        kAnyQuality,
            "-o",        output};
  }
  // The walk in a scene that somebody else has made, without a marker.
  std::string foreign_scene(const std::string& name) const {
    const fs::path to = folder_.path() / name;
    fs::copy(folder_ / "walk", to, fs::copy_options::recursive);
    fs::remove(to / ".walktrack_render");
    return (to / "scene.yaml").string();
  }
  std::map<std::string, std::string> content() const {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
      if (entry.is_regular_file()) found[entry.path()] = read_file(entry.path());
    return found;
  }
  // With and without -y.
  void expect_refused(Words words, const std::string& reason) const {
    const auto before = content();
    for (const bool yes : {false, true}) {
      if (yes) words.emplace_back("-y");
      const ProgramResult run = run_walktrack(words);
      EXPECT_EQ(run.exit_code, 2) << words[0] << run.err;
      EXPECT_THAT(run.err, HasSubstr(reason)) << words[0];
      EXPECT_THAT(run.err, AnyOf(HasSubstr("choose another"), HasSubstr("another one to write"),
                                 HasSubstr("-y")))
          << words[0];
      EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
      EXPECT_EQ(content(), before) << words[0];
    }
  }

  const TemporaryFolder folder_;
};

TEST_F(OwnFiles, AnalyseKeepsItsInput) {
  folder_.write("mine/joints.csv", read_file(folder_ / "walk/truth.csv"));
  folder_.write("mine/report.html", "my report");
  expect_refused({"analyse", folder_ / "mine/joints.csv", "-o", folder_ / "mine"},
                 "mine: found 'joints.csv', which the command reads");
  expect_refused({"analyse", folder_ / "mine", "-o", folder_ / "mine/../mine"},
                 "which the command");
  expect_refused({"analyse", folder_ / "walk/truth.csv", "-o", folder_ / "mine"},
                 "mine/report.html: found a file that 'walktrack analyse' has not marked");
}

TEST_F(OwnFiles, TrackKeepsItsScene) {
  const std::string scene = foreign_scene("mine");
  expect_refused(track(scene, folder_ / "mine"), "mine: found 'scene.yaml', which");
  expect_refused(track(folder_ / "walk/scene.yaml", folder_ / "walk"), "walk: found 'scene.yaml'");
  expect_refused(track(scene, folder_ / "walk"), "walk: found a scene");
  fs::create_directory(folder_.path() / "out");
  fs::rename(folder_.path() / "mine/side.mp4", folder_.path() / "out/side.mp4");
  fs::create_symlink(folder_.path() / "out/side.mp4", folder_.path() / "mine/side.mp4");
  expect_refused(track(scene, folder_ / "out"), "out: found 'side.mp4', which");
}

TEST_F(OwnFiles, TrackReplacesItsOwnAndNothingElse) {
  const std::string out = folder_ / "out";
  ASSERT_THAT(run_walktrack(track(folder_ / "walk/scene.yaml", out)).exit_code, AnyOf(0, 4));
  folder_.write("out/notes.txt", "mine");
  Words again = track(folder_ / "walk/scene.yaml", out);
  EXPECT_EQ(run_walktrack(again).exit_code, 2);
  again.insert(again.end(), {"-y", "--no-overlay"});
  EXPECT_THAT(run_walktrack(again).exit_code, AnyOf(0, 4));
  EXPECT_EQ(read_file(out + "/notes.txt"), "mine");
  EXPECT_FALSE(fs::exists(out + "/overlay_side.mp4"));  // of an earlier run
}

TEST_F(OwnFiles, RenderReplacesOnlyItsOwnScenes) {
  foreign_scene("mine");
  expect_refused(render(folder_ / "mine"), "mine: found a scene");
  fs::remove(folder_.path() / "mine/scene.yaml");
  expect_refused(render(folder_ / "mine"), "/mine/");  // videos of the same names
  expect_refused({"render", folder_ / "walk/truth.csv", "-o", folder_ / "walk"},
                 "walk: found 'truth.csv', which the command reads");
  Words again = render(folder_ / "walk");
  folder_.write("walk/side_points.csv", "mine");
  EXPECT_EQ(run_walktrack(again).exit_code, 2);
  again.emplace_back("-y");
  EXPECT_EQ(run_walktrack(again).exit_code, 0);
  EXPECT_EQ(read_file(folder_ / "walk/side_points.csv"), "mine");
}

// The options file may be in the folder, as that of the demo is; a camera's name cannot be a path
// to another folder.
TEST_F(OwnFiles, RenderTakesOptionsFromItsFolder) {
  const std::string options = folder_.write("scene/options.yaml", kWalkAndFilm);
  Words words{"render", "--options", options, "-o", folder_ / "scene"};
  EXPECT_EQ(run_walktrack(words).exit_code, 0);
  words.emplace_back("-y");
  EXPECT_EQ(run_walktrack(words).exit_code, 0);
  EXPECT_EQ(read_file(options), kWalkAndFilm);
  folder_.write("scene/options.yaml", "cameras: [{name: ../side}]\n");
  EXPECT_EQ(run_walktrack(words).exit_code, 3);
  folder_.write("scene/options.yaml", "walk: {speed: 1}\ncameras: [{name: scene}]\n");
  EXPECT_EQ(run_walktrack(words).exit_code, 2);  // two files of the name scene.yaml
}

TEST_F(OwnFiles, FoldersOfOtherCommandsAreLeftAlone) {
  const std::string data = std::string(WALKTRACK_SOURCE_DIR) + "/data/demo/";
  const std::map<std::string, Words> commands{
      {"states.csv", {"simulate", "--model", "rimless_wheel", "--no-pictures"}},
      {"strip.svg", {"simulate", "--model", "articulated", "--duration", "0.01"}},
      {"gaits.csv", {"prior", "--show", "--walkers", "1"}},
      {"survival.csv", {"prior", "--show", "--model", "anthropomorphic", "--walkers", "1"}},
      {"cam0.toml",
       {"calibrate", "--camera", data + "side.yaml", "--points", data + "side_points.csv"}},
      {"check_side.png", {"check", folder_ / "walk/scene.yaml"}},
      {"sweep.csv", {"sweep", folder_ / "walk/scene.yaml", "--seeds", "1"}},
      {"summary.csv", {"batch", folder_ / "walk"}}};
  for (const auto& [file, command] : commands) {
    folder_.write("mine/" + file, "mine");
    Words words = command;
    words.insert(words.end(), {"-o", folder_ / "mine"});
    expect_refused(words, "mine/" + file + ": found a file that 'walktrack ");
    fs::remove(folder_.path() / "mine" / file);
  }
}

TEST_F(OwnFiles, FilesAreNoOutputsOfWhatReadsThem) {
  const std::string truth = folder_ / "walk/truth.csv", scene = folder_ / "walk/scene.yaml",
                    model = folder_.write("model.yaml", "model: rimless_wheel\n"),
                    settings = folder_.write("mine.yaml", "seed: 2 # mine\n");
  for (Words words : {Words{"evaluate", truth, truth, "--plot", truth},
                      Words{"evaluate", truth, folder_ / "walk/truth.csv", "-o", truth},
                      Words{"plan", scene, "-o", folder_ / "walk/side.yaml"},
                      Words{"config", "-c", settings, "-o", settings},
                      Words{"cycle", "-c", model, "--save-model", model}}) {
    words.emplace_back("-y");
    const auto before = content();
    const ProgramResult run = run_walktrack(words);
    EXPECT_EQ(run.exit_code, 2) << words[0];
    EXPECT_THAT(run.err, HasSubstr("found a file that the command reads"));
    EXPECT_EQ(content(), before) << words[0];
  }
}

TEST_F(OwnFiles, TheSelftestWorksInAFolderOfItsOwn) {
  folder_.write("mine/00/video", "mine");
  folder_.write("mine/00.log", "mine");
  {
    StartedProgram program(WALKTRACK_BINARY, {"selftest", "-o", folder_ / "mine"});
    const auto begun = [&] {
      return std::distance(fs::directory_iterator(folder_.path() / "mine"),
                           fs::directory_iterator()) > 2;
    };
    while (!begun()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    program.send(SIGTERM);
    program.wait();
  }
  EXPECT_EQ(read_file(folder_ / "mine/00/video"), "mine");
  EXPECT_EQ(read_file(folder_ / "mine/00.log"), "mine");
  const ProgramResult trial =
      run_walktrack({"selftest", "--trial", "a single frame", "-o", folder_ / "mine"});
  EXPECT_EQ(trial.exit_code, 2);
  EXPECT_THAT(trial.err, HasSubstr("a new or empty folder"));
}

}  // namespace
}  // namespace walktrack
