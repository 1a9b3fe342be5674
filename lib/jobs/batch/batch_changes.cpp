#include "jobs/batch/batch_changes.h"

#include <map>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "io/config/text.h"
#include "io/config/yaml.h"
#include "io/scene/scene_template.h"
#include "jobs/track/track_origin.h"
#include "jobs/track/track_run.h"

namespace walktrack {

namespace fs = std::filesystem;

namespace {

// A scene that is made of the template is to be the one that the result is of.
bool template_changed(const BatchJob& job, const Sequence& sequence) {
  return !sequence.video.empty() &&
         (!fs::exists(sequence.scene) || read_text_file(sequence.scene, kMaxYamlBytes) !=
                                             scene_for_video(job.scene_template, sequence.video));
}

std::string changes_of(const BatchJob& job, const Sequence& sequence) {
  const bool begun = is_complete_result(sequence.output) ||
                     fs::exists(sequence.output / std::string(kCheckpointFile));
  if (!begun) return "";
  if (template_changed(job, sequence))
    return job.scene_template.filename().string() + " has changed";
  try {
    return changes_since(sequence.output, origin_of_track(read_scene(sequence.scene), *job.config));
  } catch (const InputError& error) {
    return error.what();  // it could be read once
  }
}

}  // namespace

std::vector<ChangedSequence> changed_sequences(const BatchJob& job,
                                               const std::vector<Sequence>& sequences) {
  std::vector<ChangedSequence> out;
  if (!job.config || job.overwrite) return out;
  for (const Sequence& sequence : sequences) {
    std::string changes = changes_of(job, sequence);
    if (!changes.empty()) out.push_back({sequence.name, std::move(changes)});
  }
  return out;
}

std::string changes_text(const std::vector<ChangedSequence>& changed) {
  std::map<std::string, std::string> names;
  for (const ChangedSequence& each : changed) {
    std::string& list = names[each.changes];
    list += (list.empty() ? "" : ", ") + one_line(each.name);
  }
  std::string text;
  for (const auto& [changes, list] : names)
    text += fmt::format("\n  {}: {}", one_line(changes), list);
  return text;
}

}  // namespace walktrack
