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

BatchWork work_of(const BatchJob& job) {
  BatchWork out;
  for (const Sequence& sequence : shard_of(sequences_of(job), job.shard, job.shards)) {
    // A failure may stand beside a complete result: then the last try to make it again failed.
    const bool failed = result_of(sequence).state == SequenceState::kFailed;
    if (job.retry_failed && !failed) continue;
    std::string changes = job.config ? changes_of(job, sequence) : "";
    if (!changes.empty() && !job.overwrite) {
      out.left.push_back({sequence.name, std::move(changes)});
      continue;
    }
    const bool again = job.retry_failed || (job.overwrite && (failed || !changes.empty()));
    if (again || !is_complete_result(sequence.output)) out.to_do.push_back(sequence);
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
