#include "tests/regression/suite.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/archive/files.h"
#include "io/scene/render_file.h"
#include "io/tables/motion_file.h"
#include "jobs/evaluate/evaluate.h"
#include "jobs/render/render.h"
#include "metrics/statistics/statistics.h"

namespace walktrack {

namespace {

namespace fs = std::filesystem;

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr size_t kMaxRunJson = size_t{1} << 24;

// A man stands, walks four steps and stands; of his standing, half a second before.
constexpr Clip telephones(std::string_view scene) {
  return {scene, "opencap_two_phones/toe_plants.csv", Frames{95, 309}, Frames{125, 310}};
}

constexpr SuiteScene kScenes[] = {
    {"three_cameras", true},
    {"one_camera", true},
    {"slow", false},
    {"fast", false},
    {"turn", false},
    {"turn_one_camera", false},
    {"slope", false},
    {"low_light", false},
    {"dark", true},
    {"monochrome", true},
    {"blur", false},
    {"field", false},
    {"occluder", false},
    {"seven_fps", true},
    {"fps_120", false},
    {"second_walker", false},
    {"flow_only", true},
    {"unaided", false},
    {"slope_up", false},
    {"slope_down", false},
    {"stout", false},
    {"skirt", false},
    {"child", true},
    {"stooped", false},
    {"long_legs", false},
    {"clip_side_view", false, Clip{"sports2d_side/scene.yaml", "sports2d_side/footplants.csv"}},
    {"clip_two_telephones", true, telephones("opencap_two_phones/scene_plates.yaml")},
    {"clip_telephone_0", false, telephones("opencap_two_phones/scene_cam0.yaml")},
    {"clip_telephone_1", false, telephones("opencap_two_phones/scene_cam1.yaml")},
    {"clip_walker_1", true, Clip{"pets_view001/walker1.yaml", "pets_view001/walker1_ground.csv"}},
    {"clip_walker_13", false,
     Clip{"pets_view001/walker13.yaml", "pets_view001/walker13_ground.csv"}},
    {"clip_walker_17", false,
     Clip{"pets_view001/walker17.yaml", "pets_view001/walker17_ground.csv"}},
    {"clip_squats", true, Clip{.scene = "opencap_squats/scene.yaml", .part = Frames{0, 59}}},
    {"clip_balance", false, Clip{"pose2sim_balance/scene.yaml"}},
};

const SuiteScene& scene_named(std::string_view name) {
  return *std::ranges::find(kScenes, name, &SuiteScene::name);
}

fs::path suite_folder() { return fs::path(WALKTRACK_SOURCE_DIR) / "tests/regression"; }

fs::path suite_file(std::string_view name, const char* suffix) {
  return suite_folder() / "scenes" / (std::string(name) + suffix);
}

// A clip's part of its video, and the truth, if `evaluate` knows it.
void cut(Scene& scene, const Clip& clip) {
  if (!clip.truth.empty() && !holds_landings(clip.truth)) scene.truth = file_of(clip.truth);
  if (!clip.part) return;
  scene.first_frame = clip.part->first;
  scene.last_frame = clip.part->last;
}

double median_evidence(const nlohmann::json& run) {
  std::vector<double> values;
  for (const nlohmann::json& value : run.at("by_frame").at("log_evidence"))
    if (value.is_number()) values.push_back(value);
  return values.empty() ? kNoValue : quantile(std::move(values), 0.5);
}

// RMS of the flexion of a joint, over both legs.
double rms_of_sides(const FigureValues& values, const std::string& joint) {
  const auto of = [&](const char* side) {
    const std::string angle = joint == "ankle" ? "_dorsiflexion" : "_flexion";
    return values.at("angle_" + (side + joint) + angle + "_rms_deg");
  };
  return std::hypot(of("l"), of("r")) / std::sqrt(2.0);
}

}  // namespace

std::span<const SuiteScene> suite_scenes() { return kScenes; }

fs::path bands_file() { return suite_folder() / "bands.csv"; }

fs::path excuses_file() { return suite_folder() / "worse.csv"; }

bool is_there(const SuiteScene& scene) { return !scene.clip || is_there(*scene.clip); }

fs::path rendered_scene(std::string_view name, const fs::path& folder) {
  if (const SuiteScene& known = scene_named(name); known.clip) return file_of(known.clip->scene);
  const fs::path scene = folder / name;
  if (fs::exists(scene / "scene.yaml")) return scene / "scene.yaml";
  RenderJob job;
  RenderFile file = read_render_file(suite_file(name, ".yaml"));
  job.walker = std::move(file.subject);
  job.options = std::move(file.options);
  job.gait = std::move(file.gait);
  job.output = scene;
  render_scene(job, {});
  return scene / "scene.yaml";
}

TrackJob suite_job(std::string_view name, const fs::path& scene, uint64_t seed,
                   const fs::path& output) {
  TrackJob job;
  job.scene = read_scene(scene);
  if (const SuiteScene& known = scene_named(name); known.clip) cut(job.scene, *known.clip);
  apply_config_file(job.config, (suite_folder() / "track.yaml").string());
  const fs::path own = suite_file(name, ".track.yaml");
  if (fs::exists(own)) apply_config_file(job.config, own.string());
  job.config.values.seed = seed;
  job.output = output;
  job.overwrite = true;
  job.overlay = false;
  return job;
}

SuiteResult tracked(const TrackJob& job, const std::optional<Clip>& clip) {
  const TrackOutcome outcome = track_scene(job, {});
  const auto run = nlohmann::json::parse(read_text_file(job.output / "run.json", kMaxRunJson));
  SuiteResult out;
  if (!job.scene.truth.empty()) out.truth = read_truth(job.scene.truth, job.scene.frame_rate);
  out.estimate = read_motion(job.output / "joints.csv");
  out.uncertainty = read_uncertainty(job.output / "uncertainty.csv");
  out.log_evidence = median_evidence(run);
  out.digest = run.at("digest");
  if (clip) out.clip = facts_of(*clip, job.scene.first_frame, clip_run(outcome, run));
  return out;
}

FigureValues values_of(const SuiteResult& result) {
  FigureValues out;
  if (result.truth) {
    for (const Figure& figure : figures(*result.truth, result.estimate, result.uncertainty))
      out[figure.key] = figure.value;
  }
  if (result.clip) out.merge(clip_figures(*result.clip, result.estimate));
  out["log_evidence"] = result.log_evidence;
  if (result.clip) return out;
  for (const char* joint : {"hip", "knee", "ankle"})
    out[std::string(joint) + "_rms_deg"] = rms_of_sides(out, joint);
  for (const char* key : {"speed_m_s", "step_length_m", "step_time_s"}) out.erase(key);
  return out;
}

std::vector<SuiteResult> suite_results(std::string_view name, size_t seeds,
                                       const fs::path& folder) {
  const fs::path scene = rendered_scene(name, folder);
  std::vector<SuiteResult> out;
  for (uint64_t seed = 1; seed <= seeds; ++seed)
    out.push_back(tracked(suite_job(name, scene, seed, folder / "result"), scene_named(name).clip));
  return out;
}

std::vector<FigureValues> values_of(const std::vector<SuiteResult>& results) {
  std::vector<FigureValues> out;
  for (const SuiteResult& result : results) out.push_back(values_of(result));
  return out;
}

}  // namespace walktrack
