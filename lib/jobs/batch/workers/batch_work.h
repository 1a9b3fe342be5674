// Tracks one sequence of a batch: claims it, starts it and ends it.
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
  std::optional<ChildProcess> child;  // nullopt if the result only has to be moved to its place
};

// Throws a UsageError if one of the folders from `output` to the one of this name is a link.
void refuse_links(const std::filesystem::path& output, const std::filesystem::path& name);

// Throws a UsageError if the sequence's results would be outside the output, or among files that do
// not belong to the batch.
void refuse_place(const BatchJob& job, const Sequence& sequence, Todo todo);

// The time by the clock of the output's file system, which can be compared with the times of other
// workers' files even if the clocks of machines differ.
std::filesystem::file_time_type time_of_output(const BatchJob& job);

// Starts the sequence if it is still to be tracked and no other worker is tracking it, and removes
// the reason of an earlier failure.
std::optional<RunningSequence> start_sequence(const BatchJob& job, const Sequence& sequence,
                                              Todo todo, std::filesystem::file_time_type began);

// To be called when the child has ended (nullopt: there was none): moves the result to its place,
// or records the reason of the failure. Nothing is recorded for sequences that were interrupted.
// `alive` is called while that takes long.
void end_sequence(const BatchJob& job, const RunningSequence& running,
                  const std::optional<ChildEnd>& end, bool stopping,
                  const std::function<void()>& alive);

}  // namespace jobs
}  // namespace walktrack
