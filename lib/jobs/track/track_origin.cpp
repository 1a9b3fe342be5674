#include "jobs/track/track_origin.h"

#include <fmt/format.h>

#include "core/version.h"
#include "io/archive/files.h"
#include "io/archive/sha256.h"
#include "jobs/track/detections.h"
#include "jobs/track/pose_model.h"

namespace walktrack {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMaxTextBytes = size_t{1} << 24;

std::string program() {
  const BuildFacts& facts = build_facts();
  return fmt::format("{} {} {} {}", facts.version, facts.commit, facts.build_type, facts.compiler);
}

std::string scene_texts(const Scene& scene) {
  std::string text = read_text_file(scene.file, kMaxTextBytes);
  for (const SceneCamera& camera : scene.cameras)
    text += read_text_file(camera.calibration, kMaxTextBytes);
  return text;
}

std::string settings(const Config& config) {
  std::string text;
  for (const auto& [key, value] : config_values(config))
    if (key != "threads") text += fmt::format("{}: {}\n", key, value);
  return text;
}

// Of a printf pattern, which is no file, its folder stands for the frames.
std::string film(const fs::path& path) {
  if (path.empty()) return "none";
  const fs::path seen = is_frame_pattern(path) ? path.parent_path() : path;
  const auto size = fs::is_regular_file(seen) ? fs::file_size(seen) : 0;
  return fmt::format("{} {}", size, fs::last_write_time(seen).time_since_epoch().count());
}

// What keypoints come from, if they are used: the files' content.
std::string keypoint_digests(const TrackJob& job) {
  const KeypointConfig& config = job.config.values.observation.keypoints;
  if (!keypoints_wanted(job.scene, config)) return "none";
  std::string text;
  for (const SceneCamera& camera : job.scene.cameras) {
    if (camera.keypoints.path.empty()) continue;
    for (const fs::path& file : keypoint_files(camera.keypoints))
      text += sha256(read_text_file(file, kMaxKeypointBytes));
  }
  const auto model = pose_model_file(config.model);
  return text + (model ? sha256(read_text_file(*model, kMaxModelBytes)) : "");
}

}  // namespace

Origin origin_of(const TrackJob& job) {
  std::string films;
  for (const SceneCamera& camera : job.scene.cameras)
    films += fmt::format("{}\n{}\n", film(camera.video), film(camera.background));
  return {{"version of the program", program()},
          {"scene", sha256(scene_texts(job.scene))},
          {"configuration", sha256(settings(job.config.values))},
          {"film", sha256(films)},
          {"keypoints", sha256(keypoint_digests(job))}};
}

}  // namespace walktrack
