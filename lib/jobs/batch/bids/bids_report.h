// The files that a batch over a BIDS data set writes in addition to its results: a derivative data
// set with the tables of bids_tables.h, sub-<label>[/ses-<label>]/motion/..., made from the results
// as they are.
#pragma once

#include "io/archive/result_folder.h"
#include "jobs/batch/sequence_list.h"

namespace walktrack {
inline namespace jobs {

inline constexpr const char* kBidsDescription = "dataset_description.json";

// `folder`: the output, which lists kBidsDescription. Tables of results that are no more go. Where
// there is no .bidsignore one is made that names what is not of BIDS. UsageError for files of these
// names that no batch has written.
void write_bids(const BatchJob& job, const SequenceList& list, const ResultFolder& folder);

}  // namespace jobs
}  // namespace walktrack
