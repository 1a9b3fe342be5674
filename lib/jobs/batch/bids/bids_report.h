// The files that a batch over a BIDS data set writes in addition to its results: a derivative data
// set with the tables of bids_tables.h, sub-<label>[/ses-<label>]/motion/..., made from the
// results.
#pragma once

#include "io/archive/result_folder.h"
#include "jobs/batch/sequence_list.h"

namespace walktrack {
inline namespace jobs {

inline constexpr const char* kBidsDescription = "dataset_description.json";

// `folder`: the output, which lists kBidsDescription. Tables of results that no longer exist are
// removed. If there is no .bidsignore, one is written that names the files outside of BIDS. Throws
// a UsageError if files of these names exist that no batch has written.
void write_bids(const BatchJob& job, const SequenceList& list, const ResultFolder& folder);

}  // namespace jobs
}  // namespace walktrack
