// The limit cycle near a guess, with its cost.
#pragma once

#include "walker/gait_cycle.h"

namespace walktrack {

// Newton's method from a guess of (q, qd) on the section.
inline std::optional<GaitCycle> find_gait(const Walker& walker, const Eigen::VectorXd& guess,
                                          const GaitOptions& options = {}) {
  const auto cycle =
      find_limit_cycle(step_map(walker, options), section_rows(walker), guess, options.cycle);
  if (!cycle) return std::nullopt;
  return describe_cycle(walker, *cycle, options);
}

}  // namespace walktrack
