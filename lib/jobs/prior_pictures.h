// Pictures of a table of gaits, as SVG text.
#pragma once

#include <string>
#include <vector>

#include "gait/gait_prior.h"

namespace walktrack {

// Cost of transport over speed and step length on the level, one rectangle a valid node.
std::string cost_picture(const GaitPrior& prior, const WalkerUnits& units);

struct CheapestStep {
  double speed = 0;        // m/s
  double step_length = 0;  // m
  double cost = 0;         // of transport there
};

// The cheapest step length at every speed of the table where the least cost lies inside, by a
// parabola through the three cheapest valid nodes on the level.
std::vector<CheapestStep> cheapest_steps(const GaitPrior& prior, const WalkerUnits& units);

// The cheapest step length against speed beside the one that people prefer.
std::string cheapest_picture(const std::vector<CheapestStep>& steps, const WalkerUnits& units);

// Stick figures through one stride: slow, normal, fast, uphill, downhill.
std::string strips_picture(const GaitPrior& prior, const KneedParameters& walker);

}  // namespace walktrack
