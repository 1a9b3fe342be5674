#include "jobs/batch/workers/work_folder.h"

#include "core/errors.h"
#include "io/archive/sha256.h"
#include "jobs/batch/workers/folder_move.h"
#include "jobs/track/track_run.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr size_t kDigits = 12;

// The same name for one output folder, however its path is written.
fs::path work_of_output(const BatchJob& job) {
  const std::string output = fs::weakly_canonical(fs::absolute(job.output)).string();
  return fs::absolute(job.work) / ("walktrack-" + sha256(output).substr(0, kDigits));
}

}  // namespace

fs::path tracked_in(const BatchJob& job, const Sequence& sequence) {
  return job.work.empty() ? sequence.output : work_of_output(job) / sequence.name;
}

fs::path tracked_scene(const BatchJob& job, const Sequence& sequence) {
  if (job.work.empty() || sequence.video.empty()) return sequence.scene;
  return hidden_folder(sequence.output) / sequence.scene.filename();
}

void refuse_work_in_output(const BatchJob& job) {
  if (job.work.empty()) return;
  const fs::path work = fs::weakly_canonical(fs::absolute(job.work));
  const fs::path below = work.lexically_relative(fs::weakly_canonical(fs::absolute(job.output)));
  if (!below.empty() && *below.begin() != "..")
    throw UsageError(describe({job.work.string(), 0, "--work"}, "a folder in the output",
                              "one elsewhere, on a disk of this machine"));
}

void show_result(const BatchJob& job, const Sequence& sequence, const SequenceClaim& claim,
                 const std::function<void()>& alive) {
  const fs::path made = tracked_in(job, sequence);
  // Removes the files of both commands. Other files are the user's and are kept.
  remove_marked(sequence.output, "track");
  remove_marked(sequence.output, "batch");
  move_folder(made, sequence.output, claim.folder(), kRunFile, alive);
  clear_work(job, sequence);
}

void clear_work(const BatchJob& job, const Sequence& sequence) {
  // Folders above it are kept, because another worker may be about to use them.
  const fs::path folder = tracked_in(job, sequence);
  if (!fs::exists(folder / kCheckpointFile)) fs::remove_all(folder);
}

}  // namespace jobs
}  // namespace walktrack
