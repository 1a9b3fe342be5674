// The files that a batch makes of its result folders: summary.csv, failures.txt and batch.html.
#pragma once

#include "io/archive/result_folder.h"
#include "jobs/batch/batch_job.h"
#include "jobs/batch/batch_sequences.h"
#include "jobs/batch/sequence_list.h"

namespace walktrack {
inline namespace jobs {

// Counts one more sequence.
void add_result(const Sequence& sequence, const SequenceResult& result, BatchOutcome& out);

// Writes summary.csv, failures.txt and batch.html, and returns the totals. Throws a UsageError if
// such files exist that no batch has written. The page shows the first 10,000 sequences.
BatchOutcome write_batch_reports(const BatchJob& job, const SequenceList& list);

// The outputs in the batch's own folder.
Outputs batch_outputs(const BatchJob& job);

}  // namespace jobs
}  // namespace walktrack
