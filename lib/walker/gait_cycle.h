// The limit cycle of a walker: the return map of limit_cycle.h is one complete step, from just
// after support transfer (or from an apex) to the next.
#pragma once

#include <optional>

#include "walker/limit_cycle.h"
#include "walker/simulate.h"

namespace walktrack {
inline namespace walker {

struct GaitOptions {
  SimulationOptions simulation;
  CycleOptions cycle;
  double max_time = 20;  // s, for one step
};

// x = (q, qd) on the section.
ReturnMap step_map(const Walker& walker, const GaitOptions& options);
SectionRows section_rows(const Walker& walker);

struct GaitCycle {
  WalkerState start;
  LimitCycle cycle;
  WalkerStep step;               // one step of the cycle
  double speed = 0;              // m/s
  double cost_of_transport = 0;  // positive actuator work per weight and distance
};

// Describes the cycle at `x`, which has been found; nullopt if the step cannot be walked.
std::optional<GaitCycle> describe_cycle(const Walker& walker, const LimitCycle& cycle,
                                        const GaitOptions& options);

}  // namespace walker
}  // namespace walktrack
