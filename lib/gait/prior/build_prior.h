// Builds the gait prior: from one gait outwards over the grid; each node is continued from its
// solved neighbours and then optimised. Units L = M = g = 1.
#pragma once

#include <functional>
#include <vector>

#include "gait/optimal_gait.h"
#include "gait/prior/gait_prior.h"

namespace walktrack {
inline namespace gait {

struct PriorGrid {
  // 0.5 ... 2.2 m/s for a leg of 0.93 m, denser where gaits change most.
  std::vector<double> speeds = {0.165, 0.2,    0.2355, 0.27,   0.306, 0.3765,
                                0.447, 0.5175, 0.588,  0.6585, 0.729};
  std::vector<double> ratios = {0.7, 0.8, 0.9, 1, 1.1, 1.2, 1.3};
  std::vector<double> slopes = {-0.08, -0.04, 0, 0.04, 0.08};  // rad, up to 8 %
  GaitObjective objective;
  GaitSearch search;
  int sweeps = 2;           // over all nodes, each of which is tried again from all its neighbours
  double attraction = 0.3;  // of a node to the mean of its neighbours in the sweeps
  double effort = 1;        // of the feedback, see feedback.h
};

// The limits of people's gaits, which a valid node keeps.
struct ValidGait {
  double least_clearance = 0.01 / 0.9275;  // leg lengths: 1 cm
  double least_swing_flexion = 0.785;      // rad, 45 deg
  double most_swing_flexion = 1.309;       // rad, 75 deg
  double most_stance_flexion = 0.436;      // rad, 25 deg
};

// Measures, multipliers, feedback and validity of a cycle.
GaitNode measured_node(const GaitVector& cycle, const GaitTarget& target, double effort);

// Valid gaits of `earlier` (an unfinished or smaller table) on nodes of the grid are kept, and only
// the others are searched. `progress` is called after every ring and sweep with the table so far,
// which is a valid `earlier`, and the number of nodes that have been tried; if it returns false,
// building stops and returns that table. The result does not depend on the number of threads.
using PriorProgress = std::function<bool(const GaitPrior&, size_t tried)>;
GaitPrior build_gait_prior(const PriorGrid& grid, const GaitPrior& earlier, int threads,
                           const PriorProgress& progress);

}  // namespace gait
}  // namespace walktrack
