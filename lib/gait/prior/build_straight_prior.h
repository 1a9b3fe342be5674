// Builds the anthropomorphic walker's table of gaits: from a published cycle over the grid, each
// node continued from its solved neighbours. It takes a second or two on one core, so that nothing
// is resumed; the result is the same every time.
#pragma once

#include <functional>

#include "gait/prior/straight_prior.h"

namespace walktrack {
inline namespace gait {

// Speeds and step lengths of the kneed walker's grid. Uphill there are no gaits: see
// lib/gait/reports/straight_gaits.md.
struct StraightPriorGrid : PriorAxes {
  StraightPriorGrid();
  double effort = 100;  // of the feedback, see feedback.h: stiffness and impulse are about 0.1, so
                        // that a change by their own size counts as 1 rad
};

// Measures, multiplier, feedback and validity of a cycle.
StraightNode measured_node(const StraightGaitVector& cycle, const GaitTarget& target,
                           double effort);

// `progress` is called with the number of solved nodes; if it returns false, building stops, and
// the result contains the nodes solved so far, with the rest copied from neighbours.
StraightPrior build_straight_prior(const StraightPriorGrid& grid,
                                   const std::function<bool(size_t)>& progress = {});

}  // namespace gait
}  // namespace walktrack
