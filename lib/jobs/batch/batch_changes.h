// The sequences that a batch has to track: those that are not complete, and those whose results
// were made by an earlier batch in another way than this one would make them.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "jobs/batch/batch.h"
#include "jobs/batch/sequence_list.h"

namespace walktrack {
inline namespace jobs {

enum class Todo : unsigned char {
  kNothing,
  kFirst,  // there is no result yet
  kAgain,  // in the place of a result
};

struct Decision {
  Todo todo = Todo::kNothing;
  std::string changes{};  // of a result that is left as it is: in words, see track_origin.h
};

// A sequence has changed if its complete result, or checkpoint, was made with another program,
// configuration or other inputs; none has where the job does not say with which configuration it
// tracks.
Decision decide(const BatchJob& job, const Sequence& sequence);

// What the result, or the checkpoint, in the folder was made of otherwise than a track of the scene
// would be now, in words; "" = nothing, or there is neither.
std::string changes_in(const std::filesystem::path& folder, const std::filesystem::path& scene,
                       const ConfigWithOrigin& config);

// The sequences of this worker's share that are to be done, in their order.
void each_to_do(const BatchJob& job, const SequenceList& list,
                const std::function<void(const Sequence&)>& use);

// Results that are left as they are, by what has changed.
class ChangedResults {
 public:
  void add(const std::string& name, const std::string& changes);
  int count() const { return count_; }
  // Each kind of change once, with the first sequences that it is about, one line a kind.
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
