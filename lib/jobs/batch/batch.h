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

#include "core/job_control.h"
#include "jobs/batch/batch_job.h"

namespace walktrack {
inline namespace jobs {

// Throws a UsageError for a folder or manifest without sequences.
BatchOutcome run_batch(const BatchJob& job, const JobControl& control);

// Whether run_batch() ends with write_batch_reports(). It does not if many workers share a
// manifest, because each of them would have to read all results.
inline bool reports_at_end(const BatchJob& job) { return job.manifest.empty() || job.shards == 1; }

}  // namespace jobs
}  // namespace walktrack
