// `track` and `batch` check a scene before they begin: failures stop them with advice, unless they
// are to be ignored. The tests use the shipped demo with one fault at a time.
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data_folders.h"
#include "tests/io/sample_files.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

// The numbers of a matrix in an OpenCV file.
std::vector<double> numbers_of(const std::string& text, const std::string& key) {
  const size_t from = text.find("data: [", text.find(key)) + 7;
  std::stringstream list(text.substr(from, text.find(']', from) - from));
  std::vector<double> out;
  for (double number = 0; list >> number; list.ignore()) out.push_back(number);
  return out;
}

std::string with_numbers(std::string text, const std::string& key, const std::vector<double>& to) {
  const size_t from = text.find("data: [", text.find(key)) + 7;
  std::ostringstream list;
  list.precision(12);
  for (size_t i = 0; i < to.size(); ++i) list << (i > 0 ? ", " : "") << to[i];
  return text.replace(from, text.find(']', from) - from, list.str());
}

class Look : public testing::Test {
 protected:
  Look() {
    for (const char* name : {"side", "front"}) set_camera(name, camera(name));
  }
  static std::string camera(const std::string& name) { return read_file(kDemo / (name + ".yaml")); }
  void set_camera(const std::string& name, const std::string& text) const {
    folder_.write("in/" + name + ".yaml", text);
  }
  void set_scene(const std::string& front, const std::string& more) const {
    std::string text = "subject: {height: 1.75, mass: 70}\nlast_frame: 40\n" + more + "cameras:\n";
    for (const std::string name : {"side", "front"}) {
      text.append("  - {name: ").append(name).append(", video: ").append((kDemo / name).string());
      text.append(".mp4, background: ").append((kDemo / name).string());
      text.append("_background.mp4, calibration: ").append(name).append(".yaml");
      text.append(name == "front" ? front : "").append("}\n");
    }
    folder_.write("in/scene.yaml", text);
  }
  ProgramResult run(const std::string& command, const std::string& input,
                    std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {command, folder_ / input, "-o", folder_ / "out", "--set",
                               "filter.particles=60", "--set", "start.particles=30"});
    return run_walktrack(more);
  }
  // The error is one line, and nothing is written.
  void expect_refused(const testing::Matcher<const std::string&>& said) const {
    const ProgramResult result = run("track", "in/scene.yaml");
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_THAT(result.err, said);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
  TemporaryFolder folder_;
};

TEST_F(Look, RefusesARateThatTheVideosDoNotHave) {
  set_scene("", "frame_rate: 60\n");
  expect_refused(AllOf(HasSubstr("the videos say 30 Hz, the scene 60 Hz"),
                       HasSubstr("; cure: set frame_rate: 30 in the scene")));
}

TEST_F(Look, RefusesMillimetres) {
  set_scene("", "");
  std::vector<double> moved = numbers_of(camera("front"), "translation");
  for (double& each : moved) each *= 1000;
  set_camera("front", with_numbers(camera("front"), "translation", moved));
  expect_refused(AllOf(HasSubstr("scene.yaml: front: "),
                       HasSubstr("; cure: the translation is in millimetres; divide it by 1000")));
}

TEST_F(Look, RefusesCamerasUnderground) {
  set_scene("", "ground: {offset: 3}\n");
  expect_refused(AllOf(HasSubstr("side: stands 1.80 m underground; cure: "),
                       HasSubstr("and 1 more, see walktrack check")));
}

// world_from_camera: (R', C) with C = -R't.
TEST_F(Look, RefusesAnInversePose) {
  set_scene("", "");
  const std::vector<double> r = numbers_of(camera("front"), "rotation"),
                            t = numbers_of(camera("front"), "translation");
  std::vector<double> turned(9), centre(3);
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      turned[3 * i + j] = r[3 * j + i];
      centre[i] -= r[3 * j + i] * t[j];
    }
  }
  const std::string wrong = with_numbers(camera("front"), "rotation", turned);
  set_camera("front", with_numbers(wrong, "translation", centre));
  expect_refused(AllOf(HasSubstr("front: "), HasSubstr("world_from_camera")));
}

TEST_F(Look, RefusesAnotherImageSize) {
  set_scene("", "");
  set_camera("side", replaced(camera("side"), "image_width: 640", "image_width: 1280"));
  expect_refused(AllOf(HasSubstr("side: frames are 640x480 px, the calibration is of 1280x480 px"),
                       HasSubstr("; cure: use the calibration of this resolution")));
}

TEST_F(Look, RefusesCamerasThatAreSixFramesOutOfStep) {
  set_scene(", start_frame: 6", "last_frame: 100\n");
  folder_.write("in/scene.yaml",
                replaced(read_file(folder_ / "in/scene.yaml"), "last_frame: 40\n", ""));
  expect_refused(AllOf(HasSubstr("side shows things 6 frames later than the other"),
                       HasSubstr("; cure: set start_frame: 0 for front")));
}

TEST_F(Look, IgnoresFailuresWhenTold) {
  set_scene("", "frame_rate: 60\n");
  const ProgramResult result = run("track", "in/scene.yaml", {"--ignore-checks", "--no-overlay"});
  EXPECT_THAT(result.exit_code, testing::AnyOf(0, 4)) << result.err;
  const std::string said = "a failed check was ignored: the videos say 30 Hz, the scene 60 Hz";
  EXPECT_THAT(result.err, HasSubstr(said));
  EXPECT_THAT(read_file(folder_ / "out/run.json"), HasSubstr(said));
  EXPECT_THAT(read_file(folder_ / "out/report.html"), HasSubstr(said));
}

TEST_F(Look, ABatchChecksItsScenesToo) {
  set_scene("", "frame_rate: 60\n");
  ProgramResult result = run("batch", "");
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_THAT(read_file(folder_ / "out/failures.txt"), HasSubstr("cure: set frame_rate: 30"));
  result = run("batch", "", {"--ignore-checks"});
  EXPECT_THAT(result.exit_code, testing::AnyOf(0, 4)) << result.err;
}

TEST_F(Look, SaysNothingOfASoundScene) {
  set_scene("", "frame_rate: 30\n");
  const ProgramResult result = run("track", "in/scene.yaml", {"--no-overlay"});
  EXPECT_THAT(result.exit_code, testing::AnyOf(0, 4)) << result.err;
  EXPECT_THAT(result.err, testing::Not(HasSubstr("cure")));
}

}  // namespace
}  // namespace walktrack
