// `batch --work DIR`: sequences are tracked below a folder of this machine and moved to the output
// when they are complete, so that a network file system neither transports temporary files nor
// shows incomplete results.
//
// DIR/walktrack-<twelve digits that stand for OUT>/<sequence> is the result folder during tracking;
// after a kill the next batch with the same DIR continues with it. A result is renamed into OUT
// (jobs/batch/workers/folder_move.h), a failure leaves failure.txt and log.txt there.
#pragma once

#include <filesystem>
#include <functional>

#include "jobs/batch/batch.h"
#include "jobs/batch/workers/sequence_claim.h"

namespace walktrack {
inline namespace jobs {

// Where the sequence is tracked: its result folder, or with a work folder one below that.
std::filesystem::path tracked_in(const BatchJob& job, const Sequence& sequence);

// The scene to track. One that is made of a template lies where its relative paths are those of
// OUT/<sequence>/scene.yaml, so that a result says the same of its inputs wherever it was made.
std::filesystem::path tracked_scene(const BatchJob& job, const Sequence& sequence);

// UsageError for a work folder that lies in the output.
void refuse_work_in_output(const BatchJob& job);

// Puts the whole result in place, in that of an earlier one. `alive`: see move_folder().
void show_result(const BatchJob& job, const Sequence& sequence, const SequenceClaim& claim,
                 const std::function<void()>& alive);

// Removes what nobody can go on with.
void clear_work(const BatchJob& job, const Sequence& sequence);

}  // namespace jobs
}  // namespace walktrack
