// Numbers and cameras at the extremes. Each ends in a verdict that is stated and correct: refused
// with an error that names the cause, nobody found, tracked but below a quality check that is
// named, or tracked. Only the last promises something, and it must be true: joints within kJoints
// of the truth on average, legs rarely swapped, nearly all frames filled. A run that says that left
// and right rest on outlines alone does not promise the names of the legs, but all else: it is held
// to the better of both. The table prints with --gtest_filter=*Extreme*; its last state is in
// tests/jobs/extremes.md.
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "core/job_control.h"
#include "io/archive/files.h"
#include "io/scene/render_file.h"
#include "io/scene/scene.h"
#include "io/tables/motion_file.h"
#include "jobs/render/render.h"
#include "jobs/track/track.h"
#include "metrics/joint_error.h"
#include "tests/body/changed_motion.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

constexpr double kJoints = 0.15;      // m, mean over the seven scored joints
constexpr double kSwapped = 0.1;      // of the frames
constexpr double kLeastFilled = 0.9;  // of the frames after the first tracked one

struct Extreme {
  const char* name;
  std::string render;            // options that differ from kUsual, key: value, one in each line
  std::string cameras;           // in place of the usual ones
  std::vector<std::string> set;  // of the configuration
  bool must_be_tracked = false;  // where anything else would be a failure, too
  uint64_t seeds = 1;            // that are tracked, each with a verdict
};

constexpr const char* kSide =
    "  - {name: side, azimuth_deg: -90, distance: 3.6, height: 1.2, focal_px: 240, size: [240, "
    "180]}\n";
constexpr const char* kFront =
    "  - {name: front, azimuth_deg: -20, distance: 4, height: 1.7, focal_px: 240, size: [240, "
    "180]}\n";

std::string camera_at(const char* name, const char* rest) {
  return fmt::format("  - {{name: {}, {}}}\n", name, rest);
}

std::string with_particles(const char* count) { return std::string("filter.particles=") + count; }

std::vector<Extreme> extremes() {
  const std::string usual = std::string(kSide) + kFront;
  const auto rate = [](const char* frames, const char* seconds) {
    return fmt::format("frame_rate: {}\nduration: {}\n", frames, seconds);
  };
  const std::vector<std::string> few{"filter.particles=150", "start.particles=60"};
  return {
      {"particles_1", "", usual, {"filter.particles=1", "start.particles=1"}},
      {"particles_2", "", usual, {"filter.particles=2", "start.particles=2"}},
      {"particles_10", "", usual, {"filter.particles=10", "start.particles=10"}},
      {"particles_1000000", "duration: 0.034\n", kSide, {with_particles("1000000")}},
      {"rate_1", rate("1", "4"), usual, few},
      {"rate_3", rate("3", "3"), usual, few},
      {"rate_240", rate("240", "0.5"), usual, few},
      {"two_frames", "duration: 0.034\n", usual, few},
      {"picture_8", "",
       camera_at("side",
                 "azimuth_deg: -90, distance: 3.6, height: 1.2, focal_px: 10, size: [8, 8]"),
       few},
      {"picture_24", "",
       camera_at("side",
                 "azimuth_deg: -90, distance: 3.6, height: 1.2, focal_px: 24, size: [24, 18]"),
       few},
      {"picture_4000", "duration: 0.3\nbackground_frames: 2\n",
       camera_at(
           "side",
           "azimuth_deg: -90, distance: 3.6, height: 1.2, focal_px: 4000, size: [4000, 3000]"),
       few},
      {"person_12_px", "",
       camera_at("side",
                 "azimuth_deg: -90, distance: 35, height: 1.2, focal_px: 240, size: [240, 180]"),
       few},
      {"top_view", "",
       camera_at("top",
                 "position: [0, 0.01, 6], look_at: [0, 0, 0], focal_px: 240, size: [240, 180]"),
       few},
      {"lens_of_170_degrees", "",
       camera_at("side",
                 "azimuth_deg: -90, distance: 3, height: 1.2, focal_px: 10.5, size: [240, 180]"),
       few},
      {"two_identical_cameras", "",
       std::string(kSide) +
           camera_at(
               "twin",
               "azimuth_deg: -90, distance: 3.6, height: 1.2, focal_px: 240, size: [240, 180]"),
       few},
      {"camera_within_the_person", "",
       std::string(kSide) +
           camera_at(
               "inside",
               "position: [0, 0, 1.1], look_at: [2, 0, 1.1], focal_px: 240, size: [240, 180]"),
       few},
      {"only_camera_within_the_person", "",
       camera_at("inside",
                 "position: [-0.8, 0, 1.1], look_at: [2, 0, 1.1], focal_px: 240, size: [240, 180]"),
       few},
      {"long_lens", "",
       camera_at("side",
                 "azimuth_deg: -90, distance: 300, height: 1.2, focal_px: 20000, size: [240, 180]"),
       few},
      {"child_of_50_cm", "subject: {height: 0.5, mass: 5}\nwalk: {speed: 0.4, start: [-0.4, 0]}\n",
       camera_at("side",
                 "azimuth_deg: -90, distance: 1.2, height: 0.4, focal_px: 240, size: [240, 180]"),
       few},
      {.name = "giant_of_250_cm_before_one_camera",
       .render = "subject: {height: 2.5, mass: 300}\n",
       .cameras = camera_at(
           "side", "azimuth_deg: -90, distance: 5, height: 1.2, focal_px: 240, size: [240, 180]"),
       .set = few,
       .seeds = 3},  // some of them name the legs wrongly
      {"giant_of_250_cm", "subject: {height: 2.5, mass: 300}\n",
       camera_at("side",
                 "azimuth_deg: -90, distance: 5, height: 1.2, focal_px: 240, size: [240, 180]") +
           camera_at(
               "front",
               "azimuth_deg: -20, distance: 5.5, height: 1.7, focal_px: 240, size: [240, 180]"),
       few},
      {"slope_of_30_degrees", "slope_deg: 30\n", usual, few},
      {"usual", "", usual, few, true},
  };
}

// A key of the extreme replaces the usual one.
std::string options_of(const Extreme& extreme) {
  const std::vector<std::pair<std::string, std::string>> usual{
      {"seed", "7"},
      {"frame_rate", "30"},
      {"duration", "1.4"},
      {"images", "true"},
      {"initial", "true"},
      {"background_frames", "8"},
      {"walk", "{speed: 1.2, start: [-0.9, 0], phase: 0.3}"}};
  std::string out = extreme.render;
  for (const auto& [key, value] : usual)
    if (extreme.render.find(key + ":") == std::string::npos) out += key + ": " + value + "\n";
  return out + "cameras:\n" + extreme.cameras;
}

struct Verdict {
  std::string word, why;
  bool names_promised = true;
  double joints = std::nan(""), swapped = std::nan("");
};

void film(const Extreme& extreme, const fs::path& folder) {
  write_file_atomically(folder / "options.yaml", options_of(extreme));
  const RenderFile file = read_render_file(folder / "options.yaml");
  RenderJob job;
  job.options = file.options;
  job.walker = file.subject;
  job.output = folder / "scene";
  render_scene(job, {});
}

TrackOutcome track(const Extreme& extreme, uint64_t seed, const fs::path& folder) {
  TrackJob job;
  job.scene = read_scene(folder / "scene/scene.yaml");
  for (const std::string& set : extreme.set) apply_setting(job.config, set, "test");
  job.config.values.seed = seed;
  job.output = folder / "tracked";
  job.overwrite = true;
  job.overlay = false;
  return track_scene(job, {});
}

// What the run says of the names of the legs; empty: they are promised.
std::string doubt_of_names(const TrackOutcome& outcome) {
  for (const std::string& note : outcome.checks)
    if (note.find("left and right then rest on outlines alone") != std::string::npos) return note;
  return "";
}

JointErrors errors_of(const fs::path& folder, bool other_names) {
  Motion tracked = read_motion(folder / "tracked/joints.csv");
  if (other_names)
    for (JointPositions& joints : tracked.joints) mirror_legs(joints);
  return joint_errors(read_motion(folder / "scene/truth.csv"), tracked);
}

Verdict verdict_of(const Extreme& extreme, uint64_t seed, const fs::path& folder) {
  Verdict out;
  try {
    if (!fs::exists(folder / "scene")) film(extreme, folder);
    const TrackOutcome outcome = track(extreme, seed, folder);
    const std::string doubt = doubt_of_names(outcome);
    out.word = status_word(outcome.status);
    out.why = outcome.failed_checks.empty() ? outcome.message + doubt
                                            : outcome.failed_checks.front().what;
    out.names_promised = doubt.empty();
    if (outcome.tracked == 0) return out;
  } catch (const InputError& error) {
    return {"refused", error.what()};
  } catch (const UsageError& error) {
    return {"refused", error.what()};
  }
  const JointErrors errors = errors_of(folder, false);
  out.joints = errors.absolute.mean;
  out.swapped = errors.swapped_share;
  return out;
}

bool is_kept(const JointErrors& errors) {
  return errors.absolute.mean < kJoints && errors.swapped_share < kSwapped &&
         errors.filled_share > kLeastFilled;
}

class ExtremeNumbers : public testing::TestWithParam<Extreme> {};

TEST_P(ExtremeNumbers, EndInAVerdictThatIsTrue) {
  const TemporaryFolder folder;
  for (uint64_t seed = 1; seed <= GetParam().seeds; ++seed) {
    const Verdict verdict = verdict_of(GetParam(), seed, folder.path());
    fmt::print("| {} | {} | {:.0f} mm | {:.0f} % | {} |\n", GetParam().name, verdict.word,
               1000 * verdict.joints, 100 * verdict.swapped,
               verdict.why.substr(0, verdict.why.find('\n')));
    EXPECT_FALSE(verdict.word.empty());
    if (verdict.word != "tracked") {
      EXPECT_FALSE(GetParam().must_be_tracked) << verdict.why;
      continue;
    }
    const bool other_names = !verdict.names_promised && verdict.swapped > 0.5;
    EXPECT_TRUE(is_kept(errors_of(folder.path(), other_names))) << "seed " << seed;
  }
}

std::string name_of(const testing::TestParamInfo<Extreme>& extreme) { return extreme.param.name; }

INSTANTIATE_TEST_SUITE_P(Table, ExtremeNumbers, testing::ValuesIn(extremes()), name_of);

}  // namespace
}  // namespace walktrack
