// A table of gaits over speed x step length x slope, of whatever walker: its axes, and how it is
// read between its nodes. Units L = M = g = 1.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace walktrack {
inline namespace gait {

struct GaitTarget {
  double speed = 0;        // body's advance per time
  double step_length = 0;  // body's advance per step
  double slope = 0;        // rad, positive downhill
};

// Step length that people choose, 0.694 m (v / 1.25 m/s)^0.42 for a leg of 0.9275 m, in leg
// lengths (the power is that of Grieve 1968, as Kuo 2001, J. Biomech. Eng. 123, quotes it). It is
// only used as the middle of a table's second axis.
double preferred_step_length(double speed);

// Nodes stand on speeds x ratios x slopes, the slope running fastest. Axes ascend.
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

// The target moved to the table's border where it lies outside.
GaitTarget within(const PriorAxes& axes, GaitTarget target);

// What a node counts for at a place between nodes: weights of cubic Hermite interpolation (tangents
// through the neighbours; straight towards the ends), and linear ones of the nodes that enclose it.
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

// The next target to try for one that no gait surrounds: its step length a tenth nearer to the
// preferred one. kMaxShifts of them leave an eighth of the way.
inline constexpr int kMaxShifts = 20;
GaitTarget shifted(GaitTarget target);

// The node nearest to a value on an axis.
size_t nearest_index(const std::vector<double>& axis, double value);

}  // namespace gait
}  // namespace walktrack
