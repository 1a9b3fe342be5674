// Which sequences a batch has to do: what is not complete, and which results of an earlier batch
// were made otherwise than this one would make them.
#pragma once

#include <string>
#include <vector>

#include "jobs/batch/batch.h"

namespace walktrack {

struct ChangedSequence {
  std::string name;
  std::string changes;  // in words, see jobs/track/track_origin.h
};

struct BatchWork {
  std::vector<Sequence> to_do;
  std::vector<ChangedSequence> left;  // as they are, though of other settings or inputs
};

// Of this worker's shard. A sequence has changed if its complete result, or checkpoint, was made
// with another program, configuration or other inputs; none has where the job does not say with
// which configuration it tracks.
BatchWork work_of(const BatchJob& job);

// Each kind of change once, with the sequences that it is about, one line a kind.
std::string changes_text(const std::vector<ChangedSequence>& changed);

}  // namespace walktrack
