// A table of gaits over speed x step length x slope for any walker: its axes, and the interpolation
// between its nodes. Units L = M = g = 1.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace walktrack {
inline namespace gait {

struct GaitTarget {
  double speed = 0;        // advance of the body per time
  double step_length = 0;  // advance of the body per step
  double slope = 0;        // rad, positive downhill
};

// Step length that people prefer, 0.694 m (v / 1.25 m/s)^0.42 for a leg of 0.9275 m, in leg
// lengths. The power is the one that models of walking use (Kuo 2001, J. Biomech. Eng. 123) and
// ascribe to Grieve; his papers (with Gear 1966; 1968) were not consulted. It is only used as the
// middle of a table's second axis.
double preferred_step_length(double speed);

// Nodes are at speeds x ratios x slopes, with the slope as the fastest index. Axes ascend.
struct PriorAxes {
  std::vector<double> speeds;  // of sqrt(g L)
  std::vector<double> ratios;  // of preferred_step_length(speed)
  std::vector<double> slopes;  // rad, positive downhill

  size_t size() const { return speeds.size() * ratios.size() * slopes.size(); }
  size_t at(size_t speed, size_t ratio, size_t slope) const {
    return (speed * ratios.size() + ratio) * slopes.size() + slope;
  }
  GaitTarget target(size_t speed, size_t ratio, size_t slope) const {
    const double v = speeds[speed];
    return {v, ratios[ratio] * preferred_step_length(v), slopes[slope]};
  }
};

template <typename Node>
struct PriorTable : PriorAxes {
  std::vector<Node> nodes;

  const Node& node(size_t speed, size_t ratio, size_t slope) const {
    return nodes[at(speed, ratio, slope)];
  }
};

// The target clamped to the limits of the table.
GaitTarget within(const PriorAxes& axes, GaitTarget target);

// The weights of a node at a point between nodes: those of cubic Hermite interpolation (tangents
// through the neighbours; linear at the ends), and linear ones for the nodes around the point.
struct NodeShare {
  size_t node;
  double cubic, linear;
};
struct NodeShares {
  std::array<NodeShare, 64> shares;
  size_t count = 0;
  const NodeShare* begin() const { return shares.data(); }
  const NodeShare* end() const { return shares.data() + count; }
};
NodeShares node_shares(const PriorAxes& axes, const GaitTarget& at);

// The next target to try if no gaits surround this one: its step length is moved by a tenth towards
// the preferred one. After kMaxShifts an eighth of the way is left.
inline constexpr int kMaxShifts = 20;
GaitTarget shifted(GaitTarget target);

// The node nearest to a value on an axis.
size_t nearest_index(const std::vector<double>& axis, double value);

}  // namespace gait
}  // namespace walktrack
