// `walktrack cycle`: finds the limit cycle of a walker, from its start as an initial guess, or by
// continuation from there in one parameter.
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
  int settling_steps = 0;  // steps of walking from the guess before Newton's method
  std::string follow_key;  // parameter to follow, e.g. "parameters.slope"; empty: none
  double follow_to = 0;    // its final value
};

struct FoundCycle {
  ModelSpec model;  // with the parameter and the start state of the cycle
  GaitCycle gait;
  std::string followed_key;                  // empty: none was followed
  std::vector<BranchChange> branch_changes;  // during the continuation
  double energy = 0;                         // J, of the fixed point
  double weight = 0;                         // N
  double angular_momentum = 0;               // kg m^2/s, largest modulus about the centre of mass
};

// std::runtime_error if no cycle is found, which states what happened instead.
FoundCycle find_cycle(const CycleJob& job);

// The result as JSON and as text.
std::string cycle_json(const FoundCycle& found);
std::string cycle_text(const FoundCycle& found);

}  // namespace jobs
}  // namespace walktrack
