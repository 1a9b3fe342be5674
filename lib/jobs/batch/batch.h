// `walktrack batch`: every sequence below a folder, each in a process of its own, so that a broken
// one costs one row of a table and nothing else.
//
// OUT/<sequence>/ is the result folder of one sequence (see io/archive/result_folder.h) with
// log.txt, the messages of its process, and failure.txt, the reason if there is no result. A batch
// that is run again skips complete sequences and tracks all others, from their checkpoints if they
// have any. Sequences whose result or checkpoint was made with other settings or inputs are left as
// they are and reported, or tracked again if that is wanted; see batch_changes.h. Several workers
// may share OUT: each claims a sequence before it tracks it (sequence_claim.h). summary.csv,
// failures.txt and batch.html are made from the result folders as they are.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/job_control.h"
#include "io/archive/result_folder.h"
#include "io/config/config.h"
#include "jobs/batch/batch_figures.h"
#include "jobs/batch/workers/child_process.h"

namespace walktrack {
inline namespace jobs {

struct Sequence {
  std::string name;  // path below the folder, e.g. "monday/trial3"
  std::filesystem::path scene, output;
  std::filesystem::path video{};  // where `scene` is yet to be made of a template and this video
};

inline constexpr const char* kFailureFile = "failure.txt";  // why there is no result

enum class SequenceState { kWaiting, kComplete, kDegraded, kFailed };

struct SequenceResult {
  SequenceState state = SequenceState::kWaiting;
  std::string reason{};                       // of failure, or of the quality check that failed
  double seconds = 0;                         // that tracking took; 0 = not known
  double cpu_seconds = 0, video_seconds = 0;  // and what went into how much video; 0 = not known
  std::string digest{};
  BatchFigures figures{};
};

struct BatchJob {
  std::filesystem::path folder, output;
  std::string manifest{};  // "", or a list of sequences in the place of the folder: manifest.h
  std::filesystem::path scene_template;  // empty, or the scene of every video below the folder
  bool bids = false;  // the folder is a BIDS data set, and the output gets BIDS tables, too
  std::filesystem::path work{};  // empty, or where sequences are tracked: work_folder.h
  // Program and options that do one sequence; "SCENE -o OUT/<sequence> --resume -y" is appended.
  std::vector<std::string> command;
  int jobs = 1;  // processes at a time
  int shard = 1,
      shards = 1;          // this worker does every shards-th sequence, beginning with the shard-th
  bool steal = false;      // then what nobody has begun of the other shares
  bool overwrite = false;  // do again what has changed or failed
  bool retry_failed = false;               // do none but those that failed
  ChildLimits limits;                      // of each sequence
  std::optional<ConfigWithOrigin> config;  // that the command tracks with
};

struct BatchOutcome {
  int complete = 0, degraded = 0, failed = 0, waiting = 0;  // of this worker's sequences
  int elsewhere = 0;                          // of the waiting ones: other workers are at them
  int stolen = 0;                             // sequences of other shares that this worker has done
  double cpu_seconds = 0, video_seconds = 0;  // of this worker's complete and degraded ones
  // Sequences whose results are of other settings or inputs, left as they are: changes_text().
  int changed = 0;
  std::string changes;
  bool interrupted = false;
};

// All files scene*.yaml below the folder, and other .yaml files that list cameras, in natural order
// of their names; not inside `output`. Links to folders are not followed.
std::vector<Sequence> find_sequences(const std::filesystem::path& folder,
                                     const std::filesystem::path& output);

// All video files below the folder, not inside `output`.
std::vector<std::filesystem::path> videos_below(const std::filesystem::path& folder,
                                                const std::filesystem::path& output);

// The same as sequences; their scenes will be OUT/<sequence>/scene.yaml.
std::vector<Sequence> find_videos(const std::filesystem::path& folder,
                                  const std::filesystem::path& output);

// The sequence's name after its scene's path below the folder: "a/b/scene.yaml" is "a/b", other
// files keep their stem.
std::string sequence_name(const std::filesystem::path& relative);

// What OUT/<sequence>/ says.
SequenceResult result_of(const Sequence& sequence);

class SequenceList;

// UsageError for a folder or manifest without sequences.
BatchOutcome run_batch(const BatchJob& job, const JobControl& control);

// Whether run_batch() ends with write_batch_reports(): not where many workers share a manifest,
// whose length each of them would have to read the results of.
inline bool reports_at_end(const BatchJob& job) { return job.manifest.empty() || job.shards == 1; }

// Counts one more sequence.
void add_result(const Sequence& sequence, const SequenceResult& result, BatchOutcome& out);

// summary.csv, failures.txt and batch.html. UsageError for such files that no batch has written.
// The page shows the first 10,000 sequences. What all come to.
BatchOutcome write_batch_reports(const BatchJob& job, const SequenceList& list);

// The batch's own folder, for them.
Outputs batch_outputs(const BatchJob& job);

std::string_view state_name(SequenceState state);

}  // namespace jobs
}  // namespace walktrack
