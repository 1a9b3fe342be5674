// The share of a batch that a worker tracks.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace walktrack {
inline namespace jobs {

struct Shard {
  int index = 1, count = 1;  // index from 1 to count
};

// Returns the value of an environment variable; nullopt if it is not set.
using Environment = std::function<std::optional<std::string>(const char* name)>;
Environment process_environment();

// Parses "i/n"; "auto" takes the numbers from the scheduler's environment:
//   Slurm        job arrays (SLURM_ARRAY_TASK_ID, _MIN, _STEP, _COUNT), times the tasks of a
//                step that srun has started (SLURM_PROCID, SLURM_STEP_NUM_TASKS)
//   Kubernetes   an Indexed Job: JOB_COMPLETION_INDEX; it does not state their number: "auto/n"
//   AWS Batch    array jobs: AWS_BATCH_JOB_ARRAY_INDEX, _SIZE
// Throws a UsageError for other words, and for "auto" if these variables are missing or incomplete.
Shard shard_from(const std::string& text, const Environment& environment);

}  // namespace jobs
}  // namespace walktrack
