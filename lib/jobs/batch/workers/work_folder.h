// `batch --work DIR`: sequences are tracked below a folder of this machine and moved to the output
// when they are complete, so that a network file system neither transports temporary files nor
// shows incomplete results.
//
// DIR/walktrack-<twelve digits of a hash of OUT>/<sequence> is the result folder during tracking;
// after a kill the next batch with the same DIR continues with it. A result is renamed into OUT
// (jobs/batch/workers/folder_move.h); a failure leaves failure.txt and log.txt there.
#pragma once

#include <filesystem>
#include <functional>

#include "jobs/batch/batch_job.h"
#include "jobs/batch/batch_sequences.h"
#include "jobs/batch/workers/sequence_claim.h"

namespace walktrack {
inline namespace jobs {

// The folder in which the sequence is tracked: its result folder, or one below the work folder.
std::filesystem::path tracked_in(const BatchJob& job, const Sequence& sequence);

// The scene to track. A scene that is made of a template is stored at a place where its relative
// paths are the same as in OUT/<sequence>/scene.yaml, so that run.json does not depend on the work
// folder.
std::filesystem::path tracked_scene(const BatchJob& job, const Sequence& sequence);

// Throws a UsageError for a work folder inside the output.
void refuse_work_in_output(const BatchJob& job);

// Moves the whole result to its place and replaces an earlier one. `alive`: see move_folder().
void show_result(const BatchJob& job, const Sequence& sequence, const SequenceClaim& claim,
                 const std::function<void()>& alive);

// Removes files from which no track can be resumed.
void clear_work(const BatchJob& job, const Sequence& sequence);

}  // namespace jobs
}  // namespace walktrack
