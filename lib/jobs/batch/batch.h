// `walktrack batch`: every sequence below a folder, each in a process of its own, so that a broken
// one costs one row of a table and nothing else.
//
// OUT/<sequence>/ is the result folder of one sequence (see io/archive/result_folder.h) with
// log.txt, what its process said, and failure.txt, why there is no result. Run again, complete
// sequences are passed over and all others done, from their checkpoints where they have left any;
// those whose result or checkpoint is of other settings or inputs are left as they are and named,
// or done again if that is wanted; see batch_changes.h.
// Several workers may share OUT: each claims a sequence before it does it. summary.csv,
// failures.txt and batch.html are made from the folders as they stand.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/job_control.h"
#include "io/archive/result_folder.h"
#include "io/config/config.h"
#include "jobs/batch/batch_figures.h"
#include "jobs/batch/child_process.h"

namespace walktrack {

struct Sequence {
  std::string name;  // path below the folder, e.g. "monday/trial3"
  std::filesystem::path scene, output;
  std::filesystem::path video{};  // where `scene` is yet to be made of a template and this video
};

inline constexpr const char* kFailureFile = "failure.txt";  // why there is no result

enum class SequenceState { kWaiting, kComplete, kDegraded, kFailed };

struct SequenceResult {
  SequenceState state = SequenceState::kWaiting;
  std::string reason{};  // of failure, or of the quality check that failed
  double seconds = 0;    // that tracking took; 0 = not known
  std::string digest{};
  BatchFigures figures{};
};

struct BatchJob {
  std::filesystem::path folder, output;
  std::filesystem::path scene_template;  // empty, or the scene of every video below the folder
  // Program and options that do one sequence; "SCENE -o OUT/<sequence> --resume -y" is appended.
  std::vector<std::string> command;
  int jobs = 1;  // processes at a time
  int shard = 1,
      shards = 1;          // this worker does every shards-th sequence, beginning with the shard-th
  bool overwrite = false;  // do again what has changed or failed
  bool retry_failed = false;               // do none but those that failed
  ChildLimits limits;                      // of each sequence
  std::optional<ConfigWithOrigin> config;  // that the command tracks with
};

struct BatchOutcome {
  int complete = 0, degraded = 0, failed = 0, waiting = 0;  // of this worker's sequences
  // Sequences whose results are of other settings or inputs, left as they are: changes_text().
  int changed = 0;
  std::string changes;
  bool interrupted = false;
};

// All files scene*.yaml below the folder, and other .yaml files that list cameras, in natural order
// of their names; not inside `output`. Links to folders are not followed.
std::vector<Sequence> find_sequences(const std::filesystem::path& folder,
                                     const std::filesystem::path& output);

// All video files below the folder; their scenes will be OUT/<sequence>/scene.yaml.
std::vector<Sequence> find_videos(const std::filesystem::path& folder,
                                  const std::filesystem::path& output);

// The one or the other, as the job wants it.
std::vector<Sequence> sequences_of(const BatchJob& job);

// The sequences of one shard, which are also what --list prints.
std::vector<Sequence> shard_of(const std::vector<Sequence>& sequences, int shard, int shards);

// What OUT/<sequence>/ says.
SequenceResult result_of(const Sequence& sequence);

// UsageError for a folder without sequences.
BatchOutcome run_batch(const BatchJob& job, const JobControl& control);

// summary.csv, failures.txt and batch.html. UsageError for such files that no batch has written.
void write_batch_reports(const std::vector<Sequence>& sequences, const Outputs& outputs);

// The batch's own folder, for them.
Outputs batch_outputs(const BatchJob& job);

std::string_view state_name(SequenceState state);

}  // namespace walktrack
