// Decides which sequences a batch has to track: those that are not complete, and those whose
// results were made by an earlier batch with other settings or inputs.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "jobs/batch/batch_job.h"
#include "jobs/batch/sequence_list.h"

namespace walktrack {
inline namespace jobs {

enum class Todo : unsigned char {
  kNothing,
  kFirst,  // there is no result yet
  kAgain,  // replaces a result
};

struct Decision {
  Todo todo = Todo::kNothing;
  std::string changes{};  // of a result that is not replaced, in words; see track_origin.h
};

// A sequence has changed if its complete result, or checkpoint, was made with another program,
// configuration or other inputs. If the job does not state its configuration, no sequence has
// changed.
Decision decide(const BatchJob& job, const Sequence& sequence);

// How the result, or the checkpoint, in the folder differs in its origin from a new track of the
// scene, in words; "" if it does not, or if there is neither.
std::string changes_in(const std::filesystem::path& folder, const std::filesystem::path& scene,
                       const ConfigWithOrigin& config);

// Calls the function for the sequences of this worker's share that are to be tracked, in their
// order.
void each_to_do(const BatchJob& job, const SequenceList& list,
                const std::function<void(const Sequence&)>& use);

// Collects results that are not replaced, by what has changed.
class ChangedResults {
 public:
  void add(const std::string& name, const std::string& changes);
  int count() const { return count_; }
  // One line for each kind of change, with the first sequences that it concerns.
  std::string text() const;

 private:
  struct Kind {
    std::string names;
    int count = 0;
  };
  std::map<std::string, Kind> kinds_;
  int count_ = 0, of_other_kinds_ = 0;
};

}  // namespace jobs
}  // namespace walktrack
