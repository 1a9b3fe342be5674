// A sequence of a batch that this worker tracks: claiming, beginning and ending it.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "io/archive/result_folder.h"
#include "jobs/batch/batch_changes.h"
#include "jobs/batch/workers/child_process.h"
#include "jobs/batch/workers/sequence_claim.h"

namespace walktrack {
inline namespace jobs {

struct RunningSequence {
  Sequence sequence;
  SequenceClaim claim;
  std::optional<ChildProcess> child;  // none where only showing the result is left to be done
};

// UsageError for a link among the folders that lead from `output` to the one of this name.
void refuse_links(const std::filesystem::path& output, const std::filesystem::path& name);

// UsageError where the sequence's results would lie elsewhere than below the output, or among files
// that are not the batch's own.
void refuse_place(const BatchJob& job, const Sequence& sequence, Todo todo);

// The time by the clock of the output's file system, with which other workers' files can be
// compared though clocks of machines differ.
std::filesystem::file_time_type time_of_output(const BatchJob& job);

// If it is still to be done, as it was when this worker began, and nobody else is at it: clears why
// an earlier try failed, and starts.
std::optional<RunningSequence> start_sequence(const BatchJob& job, const Sequence& sequence,
                                              Todo todo, std::filesystem::file_time_type began);

// After its end (none: there was no child): shows the result, or notes why there is none. Of
// sequences that were told to stop nothing is noted. `alive` is called while that takes long.
void end_sequence(const BatchJob& job, const RunningSequence& running,
                  const std::optional<ChildEnd>& end, bool stopping,
                  const std::function<void()>& alive);

}  // namespace jobs
}  // namespace walktrack
