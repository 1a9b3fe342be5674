// Pictures of a table of gaits, as SVG text.
#pragma once

#include <string>
#include <vector>

#include "gait/prior/gait_prior.h"

namespace walktrack {
inline namespace jobs {

// The cost of a gait of any walker at a node of a table.
struct CostNode {
  bool valid = false;
  double cost = 0;  // of transport
};
using CostTable = PriorTable<CostNode>;

template <typename Node>
CostTable cost_table(const PriorTable<Node>& prior) {
  CostTable table{prior, {}};
  for (const Node& node : prior.nodes) table.nodes.push_back({node.valid, node.cost_of_transport});
  return table;
}

// Cost of transport over speed and step length on level ground, one rectangle for each valid node.
std::string cost_picture(const CostTable& prior, const WalkerUnits& units);

struct CheapestStep {
  double speed = 0;        // m/s
  double step_length = 0;  // m
  double cost = 0;         // of transport there
};

// The step length of least cost at every speed of the table for which the minimum is inside the
// table, by a parabola through the three best valid nodes on level ground.
std::vector<CheapestStep> cheapest_steps(const CostTable& prior, const WalkerUnits& units);

// The step length of least cost against speed, with the one that people prefer.
std::string cheapest_picture(const std::vector<CheapestStep>& steps, const WalkerUnits& units);

// Stick figures through one stride: slow, normal, fast, uphill, downhill.
std::string strips_picture(const GaitPrior& prior, const KneedParameters& walker);

}  // namespace jobs
}  // namespace walktrack
