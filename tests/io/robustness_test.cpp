// Damaged files: thousands of damaged copies of valid ones. A reader may refuse one with an error
// for the user or read it; anything else (another exception, a crash) is a failure.
#include <gtest/gtest.h>

#include "core/errors.h"
#include "core/rng.h"
#include "io/calibration/formats/opencv.h"
#include "io/calibration/formats/toml.h"
#include "io/calibration/formats/tsai.h"
#include "io/config/config.h"
#include "io/config/yaml.h"
#include "io/scene/scene.h"
#include "io/tables/csv.h"
#include "io/tables/motion_file.h"
#include "tests/camera/sample_cameras.h"
#include "tests/io/sample_files.h"

namespace walktrack {
namespace {

size_t draw(Rng& rng, size_t n) {
  return static_cast<size_t>(rng.uniform() * static_cast<double>(n));
}

// One or two changes: a byte changed, a piece cut out, repeated, or replaced by something unusual.
std::string damaged(std::string text, Rng& rng) {
  const std::vector<std::string> nasty{"nan",      "-1e999",
                                       "[[",       "]",
                                       "{",        "&a",
                                       "*a",       "\n",
                                       "\t",       std::string(1, '\0'),
                                       "\xff\xfe", "999999999999999999999",
                                       "''",       "- ",
                                       ": ",       "#",
                                       "<<: ",     "!!binary ",
                                       "\"",       "%"};
  for (size_t injuries = 1 + draw(rng, 2); injuries > 0 && !text.empty(); --injuries) {
    const size_t at = draw(rng, text.size());
    const size_t length = std::min(text.size() - at, 1 + draw(rng, 6));
    switch (draw(rng, 4)) {
      case 0:
        text[at] = static_cast<char>(draw(rng, 256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      default:
        text.replace(at, length, nasty[draw(rng, nasty.size())]);
    }
  }
  return text;
}

// Reads `copies` damaged copies; counts those that were read and those that were refused.
template <typename Read>
void expect_sound_reader(const std::string& text, int copies, Read read) {
  Rng rng(5, Purpose::kTest);
  int taken = 0, refused = 0;
  for (int i = 0; i < copies; ++i) {
    const std::string copy = damaged(text, rng);
    try {
      read(copy);
      ++taken;
    } catch (const InputError&) {
      ++refused;
    } catch (const UsageError&) {
      ++refused;
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << "\n" << copy;
    }
  }
  // The changes are of a size for which both happen: otherwise this tests nothing.
  EXPECT_GT(taken, copies / 100);
  EXPECT_GT(refused, copies / 100);
}

constexpr int kCopies = 1500;

TEST(DamagedFiles, OpenCvCalibration) {
  expect_sound_reader(kCalibrationText, kCopies,
                      [](const std::string& text) { camera_from_opencv(text, "c.yaml"); });
}

TEST(DamagedFiles, TomlCalibration) {
  const std::string text = toml_from_cameras({{"a", sample_camera(sample_lenses()[1])}});
  expect_sound_reader(text, kCopies,
                      [](const std::string& copy) { camera_from_toml(copy, "c.toml", "a"); });
}

TEST(DamagedFiles, TsaiCalibration) {
  const std::string text =
      "<Camera><Geometry width=\"768\" height=\"576\" dpx=\"5.1e-03\" dpy=\"4.6e-03\"/>\n"
      "<Intrinsic focal=\"5.5\" kappa1=\"5.0e-03\" cx=\"324\" cy=\"282\" sx=\"1.09\"/>\n"
      "<Extrinsic tx=\"8\" ty=\"-3\" tz=\"35\" rx=\"2\" ry=\"-1\" rz=\"0\"/></Camera>\n";
  expect_sound_reader(text, kCopies,
                      [](const std::string& copy) { camera_from_tsai(copy, "c.xml"); });
}

TEST(DamagedFiles, Motion) {
  const TemporaryFolder folder;
  const std::string text =
      "t,neck_x,neck_y,neck_z,lhip_x,lhip_y,lhip_z\n0,1,2,3,,,\n0.04,1,2,3,4,5,6\n0.08,1,2,3,4,5,"
      "6\n";
  expect_sound_reader(text, kCopies,
                      [&](const std::string& copy) { read_motion(folder.write("j.csv", copy)); });
}

TEST(DamagedFiles, Configuration) {
  const TemporaryFolder folder;
  const std::string text = config_as_yaml({}, ConfigScope::kEverything, false);
  expect_sound_reader(text, kCopies / 3, [&](const std::string& copy) {
    ConfigWithOrigin config;
    apply_config_file(config, folder.write("c.yaml", copy));
  });
}

TEST(DamagedFiles, Scene) {
  const TemporaryFolder folder;
  folder.write("a.yaml", kCalibrationText);
  folder.write("a.mp4", "");
  const std::string text =
      "cameras:\n  - {name: a, video: a.mp4, calibration: a.yaml, start_frame: 3}\n"
      "frame_rate: 50\nground: {normal: [0, 0, 2], offset: 0.2}\ngravity: [0.5, 0, -9.8]\n"
      "subject: {height: 1.6, mass: 55, lengths: {thigh: 0.41}}\n"
      "initial: {time: 0.5, position: [1, 2], heading: -0.3, speed: 1.2}\n"
      "occluders: {a: [[[0, 0], [10, 0], [10, 10]]]}\nfirst_frame: 5\nlast_frame: 9\n";
  expect_sound_reader(text, kCopies / 3, [&](const std::string& copy) {
    read_scene(folder.write("scene.yaml", copy));
  });
}

TEST(HostileYaml, DeepNestingAndSelfReferenceEnd) {
  EXPECT_THROW(YamlValue::from_text(std::string(100'000, '['), "f"), InputError);
  EXPECT_THROW(YamlValue::from_text(std::string(100'000, '{'), "f"), InputError);
  // Nine levels of nine aliases: a billion values that must not be expanded.
  std::string text = "a: &a [x, x, x, x, x, x, x, x, x]\n";
  for (char c = 'b'; c < 'j'; ++c) {
    const std::string last(1, static_cast<char>(c - 1));
    std::string list;
    for (int i = 0; i < 9; ++i) list.append(i > 0 ? ", *" : "*").append(last);
    text.append(1, c).append(": &").append(1, c).append(" [").append(list).append("]\n");
  }
  const YamlValue root = YamlValue::from_text(text, "f");
  EXPECT_THROW(root.only_keys({"cameras"}), InputError);
  EXPECT_THROW(root.at("j").numbers(), InputError);
}

}  // namespace
}  // namespace walktrack
