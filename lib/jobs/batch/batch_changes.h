// Which results of an earlier batch were made otherwise than this one would make them.
#pragma once

#include <string>
#include <vector>

#include "jobs/batch/batch.h"

namespace walktrack {

struct ChangedSequence {
  std::string name;
  std::string changes;  // in words, see jobs/track/track_origin.h
};

// Of the sequences, those whose complete result, or checkpoint, was made with another program,
// configuration or other inputs. None where the job does not say with which configuration it
// tracks, or is to do everything again.
std::vector<ChangedSequence> changed_sequences(const BatchJob& job,
                                               const std::vector<Sequence>& sequences);

// Each kind of change once, with the sequences that it is about, one line a kind.
std::string changes_text(const std::vector<ChangedSequence>& changed);

}  // namespace walktrack
