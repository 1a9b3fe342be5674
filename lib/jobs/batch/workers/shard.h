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

// The value of an environment variable; nothing where it is not set.
using Environment = std::function<std::optional<std::string>(const char* name)>;
Environment process_environment();

// "i/n" as it is; "auto" from what the scheduler says of this worker among its equals:
//   Slurm        job arrays (SLURM_ARRAY_TASK_ID, _MIN, _STEP, _COUNT), times the tasks of a
//                step that srun has started (SLURM_PROCID, SLURM_STEP_NUM_TASKS)
//   Kubernetes   an Indexed Job: JOB_COMPLETION_INDEX; how many there are it does not say: "auto/n"
//   AWS Batch    array jobs: AWS_BATCH_JOB_ARRAY_INDEX, _SIZE
// UsageError for other words, and for "auto" where none of these says anything, or not all of it.
Shard shard_from(const std::string& text, const Environment& environment);

}  // namespace jobs
}  // namespace walktrack
