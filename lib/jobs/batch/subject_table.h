// The means over the sequences of each subject, for the batch's page.
#pragma once

#include <array>
#include <map>
#include <string>

#include "jobs/batch/batch_sequences.h"

namespace walktrack {
inline namespace jobs {

// The subject according to a sequence's name: its BIDS label ("sub-01" of
// "results/sub-01_task-walk_run-1"), otherwise its first folder ("anna" of "anna/monday/trial1");
// "" for a name without either.
std::string subject_of(const std::string& name);

struct SubjectSum {
  int sequences = 0, complete = 0;
  // Sums over the complete sequences in which the number is known.
  std::array<double, kBatchFigures.size()> sums{};
  std::array<int, kBatchFigures.size()> counts{};
};
using SubjectSums = std::map<std::string, SubjectSum>;

// Adds one sequence. After the first 10,000 subjects no others are added.
void add_to_subject(const std::string& name, const SequenceResult& result, SubjectSums& sums);

// A table with one row for each subject, with means over the complete sequences; "" if no subject
// has two sequences.
std::string subjects_html(const SubjectSums& sums);

}  // namespace jobs
}  // namespace walktrack
