#include "jobs/batch/batch_sequences.h"

#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "io/scene/scene_template.h"
#include "io/video/image_files.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMostSceneBytes = 16u << 20;
constexpr size_t kMostRecordBytes = 256u << 20;

// A file with a scene's name is included even if it is broken, so that it is reported as a failure.
bool is_scene(const fs::path& path) {
  const std::string extension = path.extension().string();
  if (extension != ".yaml" && extension != ".yml") return false;
  if (path.stem().string().starts_with("scene")) return true;
  std::error_code ignored;
  if (fs::file_size(path, ignored) > kMostSceneBytes) return false;
  const std::string text = read_text_file(path, kMostSceneBytes);
  const bool cameras = text.starts_with("cameras:") || text.find("\ncameras:") != std::string::npos;
  return cameras && text.find("video:") != std::string::npos;  // a render file lists cameras, too
}

// Regular files that `wanted` accepts and that are not inside `output`. Links to folders are not
// followed.
template <typename Wanted>
std::vector<fs::path> files_below(const fs::path& folder, const fs::path& output, Wanted wanted) {
  if (!fs::is_directory(folder)) {
    throw InputError(describe({folder.string(), 0, ""}, "no folder", "a folder with sequences"));
  }
  const fs::path out = fs::weakly_canonical(output);
  std::vector<fs::path> found;
  for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::end(entry); ++entry) {
    if (entry->is_directory() && fs::weakly_canonical(entry->path()) == out) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file() && wanted(entry->path())) {
      found.push_back(entry->path());
    }
  }
  return found;
}

std::vector<Sequence> in_natural_order(std::vector<Sequence> sequences) {
  std::sort(sequences.begin(), sequences.end(),
            [](const Sequence& a, const Sequence& b) { return natural_less(a.name, b.name); });
  return sequences;
}

std::string text_or(const nlohmann::json& json, const char* key, const std::string& otherwise) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

double number_at(const nlohmann::json& json, const char* block, const char* key) {
  const auto found = json.find(block);
  if (found == json.end() || !found->is_object()) return 0;
  const auto value = found->find(key);
  return value != found->end() && value->is_number() ? value->get<double>() : 0;
}

// CPU time and the duration of the video for which it was used. For a track that was resumed both
// count from there.
void add_cost(const nlohmann::json& run, SequenceResult& out) {
  const double rate = number_at(run, "numbers", "frame_rate"),
               cpu = number_at(run, "timing", "cpu_seconds"),
               frames = number_at(run, "numbers", "frames") -
                        number_at(run, "timing", "resumed_at_frame");
  if (rate <= 0 || cpu <= 0 || frames <= 0) return;
  out.cpu_seconds = cpu;
  out.video_seconds = frames / rate;
}

SequenceResult complete_result(const fs::path& file) {
  const auto json = nlohmann::json::parse(read_text_file(file, kMostRecordBytes), nullptr, false);
  SequenceResult result{.state = SequenceState::kComplete};
  if (!json.is_object()) {
    return {.state = SequenceState::kFailed, .reason = "run.json is broken"};
  }
  const std::string status = text_or(json, "status", "tracked");
  if (status != "tracked") {
    result.state = SequenceState::kDegraded;
    result.reason = status;
    const auto notes = json.find("notes");
    if (notes != json.end() && notes->is_array() && !notes->empty() && notes->front().is_string()) {
      result.reason += ": " + notes->front().get<std::string>();
    }
  }
  result.digest = text_or(json, "digest", "");
  result.seconds = number_at(json, "timing", "seconds");
  add_cost(json, result);
  result.figures = figures_of(json, file.parent_path());
  return result;
}

}  // namespace

std::string sequence_name(const fs::path& relative) {
  const fs::path folder = relative.parent_path();
  if (relative.stem() == "scene" && !folder.empty()) return folder.generic_string();
  return (folder / relative.stem()).generic_string();
}

std::vector<Sequence> find_sequences(const fs::path& folder, const fs::path& output) {
  std::vector<Sequence> found;
  for (const fs::path& file : files_below(folder, output, is_scene)) {
    const std::string name = sequence_name(file.lexically_relative(folder));
    found.push_back({name, fs::absolute(file).lexically_normal(), output / name});
  }
  return in_natural_order(std::move(found));
}

std::vector<fs::path> videos_below(const fs::path& folder, const fs::path& output) {
  return files_below(folder, output, is_video_file);
}

std::vector<Sequence> find_videos(const fs::path& folder, const fs::path& output) {
  const std::vector<fs::path> files = videos_below(folder, output);
  std::map<std::string, int> stems;
  const auto stem = [&](const fs::path& file) {
    return file.lexically_relative(folder).replace_extension().generic_string();
  };
  for (const fs::path& file : files) ++stems[stem(file)];
  std::vector<Sequence> found;
  for (const fs::path& file : files) {
    // "a.mp4" and "a.mov" keep their extensions, so that their names differ.
    const std::string name =
        stems[stem(file)] == 1 ? stem(file) : file.lexically_relative(folder).generic_string();
    found.push_back({name, output / name / "scene.yaml", output / name, fs::absolute(file)});
  }
  return in_natural_order(std::move(found));
}

SequenceResult result_of(const Sequence& sequence) {
  // A failure belongs to the last attempt, which may have been to replace a complete result.
  const fs::path failure = sequence.output / kFailureFile;
  if (!fs::exists(failure))
    return is_complete_result(sequence.output) ? complete_result(sequence.output / "run.json")
                                               : SequenceResult{};
  SequenceResult result{.state = SequenceState::kFailed};
  result.reason = read_text_file(failure, kMostSceneBytes);
  while (result.reason.ends_with('\n')) result.reason.pop_back();
  return result;
}

std::string_view state_name(SequenceState state) {
  switch (state) {
    case SequenceState::kComplete:
      return "complete";
    case SequenceState::kDegraded:
      return "degraded";
    case SequenceState::kFailed:
      return "failed";
    case SequenceState::kWaiting:
      break;
  }
  return "waiting";
}

}  // namespace jobs
}  // namespace walktrack
