#include "jobs/track/track_origin.h"

#include <algorithm>

#include "io/archive/checkpoint_file.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "io/archive/run_record.h"
#include "io/archive/sha256.h"
#include "io/video/video_digest.h"
#include "jobs/track/input/detections.h"
#include "jobs/track/input/pose_model.h"
#include "jobs/track/track_run.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMaxTextBytes = size_t{1} << 24;
constexpr size_t kMaxRecordBytes = size_t{1} << 30;

std::string name_from(const Scene& scene, const fs::path& file) {
  const fs::path name = file.lexically_relative(scene.file.parent_path());
  return (name.empty() ? file : name).generic_string();
}

// Digest of the content of all keypoint files of a camera.
std::string keypoint_digest(const KeypointSource& source) {
  std::string text;
  for (const fs::path& file : keypoint_files(source))
    text += file.filename().string() + sha256(read_text_file(file, kMaxKeypointBytes));
  return sha256(text);
}

}  // namespace

Origin input_digests(const Scene& scene, const KeypointConfig& keypoints) {
  Origin out;
  const auto add_as = [&](const std::string& name, const fs::path& file, auto digest) {
    const bool there = std::ranges::any_of(out, [&](const auto& e) { return e.first == name; });
    if (!file.empty() && !there) out.emplace_back(name, digest(file));
  };
  const auto add = [&](const fs::path& file, bool video) {
    add_as(name_from(scene, file), file, [&](const fs::path& path) {
      return video ? video_digest(path) : sha256(read_text_file(path, kMaxTextBytes));
    });
  };
  add(scene.file, false);
  add(scene.subject_file, false);
  for (const SceneCamera& camera : scene.cameras) {
    add(camera.calibration, false);
    add(camera.video, true);
    add(camera.background, true);
  }
  if (!is_on(keypoints)) return out;
  for (const SceneCamera& camera : scene.cameras)
    add_as(name_from(scene, camera.keypoints.path), camera.keypoints.path,
           [&](const fs::path&) { return keypoint_digest(camera.keypoints); });
  if (const auto model = pose_model_file(keypoints.model))
    add_as("model of the pose detector", *model,
           [](const fs::path& path) { return sha256(read_text_file(path, kMaxModelBytes)); });
  return out;
}

Origin origin_of(const ConfigWithOrigin& config, const Origin& inputs) {
  RunRecord record;
  record.config = config;
  record.inputs = inputs;
  return origin_in(run_json(record));
}

Origin origin_of_track(const Scene& scene, ConfigWithOrigin config) {
  config.values = decided(scene, config.values);
  return origin_of(config, input_digests(scene, config.values.observation.keypoints));
}

std::string changes_since(const fs::path& folder, const Origin& wanted) {
  if (!is_complete_result(folder)) return read_checkpoint(folder / kCheckpointFile, wanted).changed;
  return differences(origin_in(read_text_file(folder / kRunFile, kMaxRecordBytes)), wanted);
}

}  // namespace jobs
}  // namespace walktrack
