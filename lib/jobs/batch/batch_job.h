// What a batch is asked to do, and what it has done.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/config/config.h"
#include "jobs/batch/workers/child_process.h"

namespace walktrack {
inline namespace jobs {

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
  int jobs = 1;               // processes at a time
  int shard = 1, shards = 1;  // this worker tracks every shards-th sequence from the shard-th on
  bool steal = false;         // afterwards, sequences of other shares that nobody has begun
  bool overwrite = false;     // track sequences again that have changed or failed
  bool retry_failed = false;  // track only those that failed
  ChildLimits limits;         // of each sequence
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

}  // namespace jobs
}  // namespace walktrack
