#include "jobs/batch/batch_changes.h"

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
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

// Limits the message if a million results have changed.
constexpr int kMostNames = 20;
constexpr size_t kMostKinds = 100;

// The scene that is made of the template must be the scene that the result was computed from.
bool template_changed(const BatchJob& job, const Sequence& sequence) {
  return !sequence.video.empty() &&
         (!fs::exists(sequence.scene) || read_text_file(sequence.scene, kMaxYamlBytes) !=
                                             scene_for_video(job.scene_template, sequence.video));
}

std::string changes_of(const BatchJob& job, const Sequence& sequence) {
  const bool begun =
      is_complete_result(sequence.output) || fs::exists(sequence.output / kCheckpointFile);
  if (!begun || !job.config) return "";
  if (template_changed(job, sequence))
    return job.scene_template.filename().string() + " has changed";
  return changes_in(sequence.output, sequence.scene, *job.config);
}

}  // namespace

std::string changes_in(const fs::path& folder, const fs::path& scene,
                       const ConfigWithOrigin& config) {
  try {
    return changes_since(folder, origin_of_track(read_scene(scene), config));
  } catch (const InputError& error) {
    return error.what();  // it was readable before
  }
}

Decision decide(const BatchJob& job, const Sequence& sequence) {
  if (!fs::exists(sequence.output))  // true for most of a million sequences
    return {job.retry_failed ? Todo::kNothing : Todo::kFirst};
  // A failure beside a complete result is that of the last attempt to make the result again.
  const bool failed =
      (job.retry_failed || job.overwrite) && result_of(sequence).state == SequenceState::kFailed;
  if (job.retry_failed && !failed) return {};
  std::string changes = changes_of(job, sequence);
  if (!changes.empty() && !job.overwrite) return {Todo::kNothing, std::move(changes)};
  if (!is_complete_result(sequence.output)) return {Todo::kFirst};
  const bool again = job.retry_failed || (job.overwrite && (failed || !changes.empty()));
  return {again ? Todo::kAgain : Todo::kNothing};
}

void each_to_do(const BatchJob& job, const SequenceList& list,
                const std::function<void(const Sequence&)>& use) {
  auto own = list.sequences(SequenceList::Share::kOwn);
  while (const auto sequence = own.next())
    if (decide(job, *sequence).todo != Todo::kNothing) use(*sequence);
}

void ChangedResults::add(const std::string& name, const std::string& changes) {
  ++count_;
  if (kinds_.size() == kMostKinds && !kinds_.contains(changes)) {
    ++of_other_kinds_;
    return;
  }
  Kind& kind = kinds_[changes];
  if (++kind.count <= kMostNames) kind.names += (kind.count > 1 ? ", " : "") + one_line(name);
}

std::string ChangedResults::text() const {
  std::string text;
  for (const auto& [changes, kind] : kinds_) {
    text += fmt::format("\n  {}: {}", one_line(changes), kind.names);
    if (kind.count > kMostNames) text += fmt::format(" and {} more", kind.count - kMostNames);
  }
  if (of_other_kinds_ > 0) text += fmt::format("\n  and {} for other reasons", of_other_kinds_);
  return text;
}

}  // namespace jobs
}  // namespace walktrack
