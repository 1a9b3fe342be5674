#include "jobs/track/track_origin.h"

#include <algorithm>

#include "io/archive/checkpoint_file.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "io/archive/run_record.h"
#include "io/archive/sha256.h"
#include "io/video/film_digest.h"
#include "jobs/track/track_run.h"

namespace walktrack {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMaxTextBytes = size_t{1} << 24;
constexpr size_t kMaxRecordBytes = size_t{1} << 30;

std::string name_from(const Scene& scene, const fs::path& file) {
  const fs::path name = file.lexically_relative(scene.file.parent_path());
  return (name.empty() ? file : name).generic_string();
}

}  // namespace

Origin input_digests(const Scene& scene) {
  Origin out;
  const auto add = [&](const fs::path& file, bool film) {
    const std::string name = name_from(scene, file);
    const bool there = std::ranges::any_of(out, [&](const auto& e) { return e.first == name; });
    if (file.empty() || there) return;
    out.emplace_back(name, film ? film_digest(file) : sha256(read_text_file(file, kMaxTextBytes)));
  };
  add(scene.file, false);
  for (const SceneCamera& camera : scene.cameras) {
    add(camera.calibration, false);
    add(camera.video, true);
    add(camera.background, true);
  }
  return out;
}

Origin origin_of(const ConfigWithOrigin& config, const Origin& inputs) {
  RunRecord record;
  record.config = config;
  record.inputs = inputs;
  return origin_in(run_json(record));
}

std::string changes_since(const fs::path& folder, const Origin& wanted) {
  if (!is_complete_result(folder)) return read_checkpoint(folder / kCheckpointFile, wanted).changed;
  return differences(origin_in(read_text_file(folder / kRunFile, kMaxRecordBytes)), wanted);
}

}  // namespace walktrack
