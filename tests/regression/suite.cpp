#include "tests/regression/suite.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

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

constexpr SuiteScene kScenes[] = {
    {"three_cameras", true},
    {"one_camera", true},
    {"slow", false},
    {"fast", false},
    {"turn", false},
    {"slope", false},
    {"low_light", false},
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
    {"clip_side_view", false, "sports2d_side/scene.yaml", "sports2d_side/footplants.csv"},
};

fs::path data_folder() { return fs::path(WALKTRACK_SOURCE_DIR) / "../shared/data"; }

const SuiteScene& scene_named(std::string_view name) {
  return *std::ranges::find(kScenes, name, &SuiteScene::name);
}

fs::path suite_folder() { return fs::path(WALKTRACK_SOURCE_DIR) / "tests/regression"; }

fs::path suite_file(std::string_view name, const char* suffix) {
  return suite_folder() / "scenes" / (std::string(name) + suffix);
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

bool is_there(const SuiteScene& scene) {
  return scene.clip.empty() || fs::exists(data_folder() / scene.clip);
}

fs::path rendered_scene(std::string_view name, const fs::path& folder) {
  if (const SuiteScene& known = scene_named(name); !known.clip.empty())
    return (data_folder() / known.clip);
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
  if (const SuiteScene& known = scene_named(name); !known.clip.empty())
    job.scene.truth = (data_folder() / known.truth).string();
  apply_config_file(job.config, (suite_folder() / "track.yaml").string());
  const fs::path own = suite_file(name, ".track.yaml");
  if (fs::exists(own)) apply_config_file(job.config, own.string());
  job.config.values.seed = seed;
  job.output = output;
  job.overwrite = true;
  job.overlay = false;
  return job;
}

SuiteResult tracked(const TrackJob& job) {
  track_scene(job, {});
  const auto run = nlohmann::json::parse(read_text_file(job.output / "run.json", kMaxRunJson));
  return {read_truth(job.scene.truth, job.scene.frame_rate), read_motion(job.output / "joints.csv"),
          read_uncertainty(job.output / "uncertainty.csv"), median_evidence(run), run.at("digest")};
}

FigureValues values_of(const SuiteResult& result) {
  FigureValues out;
  for (const Figure& figure : figures(result.truth, result.estimate, result.uncertainty))
    out[figure.key] = figure.value;
  out["log_evidence"] = result.log_evidence;
  if (!std::holds_alternative<Motion>(result.truth)) return out;
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
    out.push_back(tracked(suite_job(name, scene, seed, folder / "result")));
  return out;
}

std::vector<FigureValues> values_of(const std::vector<SuiteResult>& results) {
  std::vector<FigureValues> out;
  for (const SuiteResult& result : results) out.push_back(values_of(result));
  return out;
}

}  // namespace walktrack
