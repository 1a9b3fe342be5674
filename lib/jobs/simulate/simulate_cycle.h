// `walktrack cycle`: the limit cycle of a walker, from its start as a guess or followed from there
// in one parameter.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "walker/gait_cycle.h"
#include "walker/model_spec.h"

namespace walktrack {
inline namespace jobs {

struct CycleJob {
  ModelSpec model;
  GaitOptions options;
  int settling_steps = 0;  // steps walked from the guess before Newton takes over
  std::string follow_key;  // parameter to follow, e.g. "parameters.slope"; empty: none
  double follow_to = 0;    // its final value
};

struct FoundCycle {
  ModelSpec model;  // with the parameter and the start of the cycle
  GaitCycle gait;
  std::string followed_key;                  // empty: none was followed
  std::vector<BranchChange> branch_changes;  // on the way, where a parameter was followed
  double energy = 0;                         // J, of the fixed point
  double weight = 0;                         // N
  double angular_momentum = 0;               // kg m^2/s, largest modulus about the centre of mass
};

// std::runtime_error where no cycle is reached, saying what happened instead.
FoundCycle find_cycle(const CycleJob& job);

// The result as JSON and as text for people.
std::string cycle_json(const FoundCycle& found);
std::string cycle_text(const FoundCycle& found);

}  // namespace jobs
}  // namespace walktrack
