// `walktrack batch`: tracks every sequence below a folder, each in a process of its own, so that a
// broken one costs only one row of a table.
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
  std::filesystem::path video{};  // the video for which `scene` is yet to be made of a template
};

inline constexpr const char* kFailureFile = "failure.txt";  // the reason why there is no result

enum class SequenceState { kWaiting, kComplete, kDegraded, kFailed };

struct SequenceResult {
  SequenceState state = SequenceState::kWaiting;
  std::string reason{};                       // of the failure, or of the quality check that failed
  double seconds = 0;                         // duration of tracking; 0 = unknown
  double cpu_seconds = 0, video_seconds = 0;  // CPU time and duration of the tracked video; 0 =
                                              // unknown
  std::string digest{};
  BatchFigures figures{};
};

struct BatchJob {
  std::filesystem::path folder, output;
  std::string manifest{};  // "", or a list of sequences instead of the folder: manifest.h
  std::filesystem::path scene_template;  // empty, or the template of a scene for every video below
                                         // the folder
  bool bids = false;  // whether the folder is a BIDS data set, so that the output gets BIDS tables,
                      // too
  std::filesystem::path work{};  // empty, or the folder in which sequences are tracked:
                                 // work_folder.h
  // Program and options that track one sequence; "SCENE -o OUT/<sequence> --resume -y" is appended.
  std::vector<std::string> command;
  int jobs = 1;  // processes at a time
  int shard = 1,
      shards = 1;          // this worker tracks every shards-th sequence, beginning with the shard-
                           // th
  bool steal = false;      // afterwards, sequences of other shares that nobody has begun
  bool overwrite = false;  // track sequences again that have changed or failed
  bool retry_failed = false;               // track only those that failed
  ChildLimits limits;                      // of each sequence
  std::optional<ConfigWithOrigin> config;  // configuration of the command
};

struct BatchOutcome {
  int complete = 0, degraded = 0, failed = 0, waiting = 0;  // of this worker's sequences
  int elsewhere = 0;                          // number of waiting ones that other workers are
                                              // tracking
  int stolen = 0;                             // sequences of other shares that this worker has
                                              // tracked
  double cpu_seconds = 0, video_seconds = 0;  // of this worker's complete and degraded ones
  // Sequences with results of other settings or inputs, which are not changed: changes_text().
  int changed = 0;
  std::string changes;
  bool interrupted = false;
};

// All files scene*.yaml below the folder, and other .yaml files that list cameras, in natural order
// of their names, except for those in `output`. Links to folders are not followed.
std::vector<Sequence> find_sequences(const std::filesystem::path& folder,
                                     const std::filesystem::path& output);

// All video files below the folder, except for those in `output`.
std::vector<std::filesystem::path> videos_below(const std::filesystem::path& folder,
                                                const std::filesystem::path& output);

// The same as sequences; their scenes will be OUT/<sequence>/scene.yaml.
std::vector<Sequence> find_videos(const std::filesystem::path& folder,
                                  const std::filesystem::path& output);

// The sequence's name according to its scene's path below the folder: "a/b/scene.yaml" is "a/b";
// other files keep their stem.
std::string sequence_name(const std::filesystem::path& relative);

// The state of OUT/<sequence>/.
SequenceResult result_of(const Sequence& sequence);

class SequenceList;

// Throws a UsageError for a folder or manifest without sequences.
BatchOutcome run_batch(const BatchJob& job, const JobControl& control);

// Whether run_batch() ends with write_batch_reports(). It does not if many workers share a
// manifest, because each of them would have to read all results.
inline bool reports_at_end(const BatchJob& job) { return job.manifest.empty() || job.shards == 1; }

// Counts one more sequence.
void add_result(const Sequence& sequence, const SequenceResult& result, BatchOutcome& out);

// Writes summary.csv, failures.txt and batch.html, and returns the totals. Throws a UsageError if
// such files exist that no batch has written. The page shows the first 10,000 sequences.
BatchOutcome write_batch_reports(const BatchJob& job, const SequenceList& list);

// The outputs in the batch's own folder.
Outputs batch_outputs(const BatchJob& job);

std::string_view state_name(SequenceState state);

}  // namespace jobs
}  // namespace walktrack
