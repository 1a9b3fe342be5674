// Builds the anthropomorphic walker's table of gaits: from a published cycle over the grid, each
// node continued from its solved neighbours. A second or two of one core, so nothing is kept on the
// way and nothing is resumed; the result is the same every time.
#pragma once

#include <functional>

#include "gait/prior/straight_prior.h"

namespace walktrack {
inline namespace gait {

// Speeds and step lengths of the kneed walker's grid. Uphill there is nothing to find: see
// lib/gait/reports/straight_gaits.md.
struct StraightPriorGrid : PriorAxes {
  StraightPriorGrid();
  double effort = 100;  // of the feedback, see feedback.h: stiffness and impulse are about 0.1, so
                        // that a change by their own size counts as 1 rad
};

// Measures, multiplier, feedback and validity of a cycle.
StraightNode measured_node(const StraightGaitVector& cycle, const GaitTarget& target,
                           double effort);

// `progress` is told how many nodes are solved; where it returns false the building stops and what
// is solved so far is returned, the rest copied from neighbours.
StraightPrior build_straight_prior(const StraightPriorGrid& grid,
                                   const std::function<bool(size_t)>& progress = {});

}  // namespace gait
}  // namespace walktrack
