#include "jobs/batch/bids/bids_names.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/video/image_files.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFormOfName = "sub-<label>[_ses-<label>]_task-<label>[_run-<index>]_video";

bool is_label(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  });
}

void append_entity(std::string& text, std::string_view key, std::string_view label) {
  text += fmt::format("{}{}-{}", text.empty() ? "" : "_", key, label);
}

// The name; InputError if it is not that of a video of the subject's folder.
BidsName checked(const fs::path& file, const fs::path& subject, const BidsName& name) {
  if (!name.label("task"))
    throw InputError(describe({file.string(), 0, ""}, "a name without task-", kFormOfName));
  const std::string of_folder = subject.filename().string();
  if (of_folder != "sub-" + *name.label("sub"))
    throw InputError(describe({file.string(), 0, ""}, "a subject that is not its folder's",
                              fmt::format("{}_...", of_folder)));
  return name;
}

std::vector<fs::path> subjects_of(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw InputError(describe({folder.string(), 0, ""}, "no folder", "a BIDS data set"));
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory() && entry.path().filename().string().starts_with("sub-"))
      out.push_back(entry.path());
  return out;
}

}  // namespace

std::optional<std::string> BidsName::label(std::string_view entity) const {
  for (const auto& [key, label] : entities)
    if (key == entity) return label;
  return std::nullopt;
}

std::optional<BidsName> bids_name(std::string_view stem) {
  BidsName name;
  for (size_t end = 0; (end = stem.find('_')) != std::string_view::npos;
       stem.remove_prefix(end + 1)) {
    const std::string_view part = stem.substr(0, end);
    const size_t dash = part.find('-');
    if (dash == std::string_view::npos) return std::nullopt;
    const std::string key(part.substr(0, dash)), label(part.substr(dash + 1));
    if (!is_label(key) || !is_label(label) || name.label(key)) return std::nullopt;
    name.entities.emplace_back(key, label);
  }
  if (!is_label(stem) || name.entities.empty() || name.entities[0].first != "sub")
    return std::nullopt;
  name.suffix = stem;
  return name;
}

std::string entities_text(const BidsName& name) {
  std::string text;
  for (const auto& [key, label] : name.entities) append_entity(text, key, label);
  return text;
}

std::string tracked_entities_text(const BidsName& name) {
  std::string text;
  for (const auto& [key, label] : name.entities) {
    append_entity(text, key, label);
    if (key == "task") append_entity(text, "tracksys", kTrackingSystem);
  }
  append_entity(text, "desc", "tracked");
  return text;
}

fs::path motion_folder(const BidsName& name) {
  fs::path folder = "sub-" + name.label("sub").value_or("");
  if (const auto session = name.label("ses")) folder /= "ses-" + *session;
  return folder / "motion";
}

std::vector<Sequence> find_bids_videos(const fs::path& folder, const fs::path& output) {
  std::map<std::string, fs::path> files;
  for (const fs::path& subject : subjects_of(folder)) {
    for (const fs::path& file : videos_below(subject, output)) {
      const auto name = bids_name(file.stem().string());
      if (!name || name->suffix != "video") continue;
      const std::string text = entities_text(checked(file, subject, *name));
      const auto [earlier, is_new] = files.emplace(text, fs::absolute(file));
      if (!is_new)
        throw InputError(describe({file.string(), 0, ""},
                                  fmt::format("the name of {}", earlier->second.string()),
                                  "names that differ in their entities"));
    }
  }
  std::vector<Sequence> found;
  for (const auto& [text, file] : files) {
    const std::string name = "results/" + text;
    found.push_back({name, output / name / "scene.yaml", output / name, file});
  }
  std::ranges::sort(found,
                    [](const auto& a, const auto& b) { return natural_less(a.name, b.name); });
  return found;
}

}  // namespace jobs
}  // namespace walktrack
