#include "gait/prior/build_straight_prior.h"

#include <algorithm>
#include <cmath>

#include "gait/feedback.h"
#include "gait/newton.h"
#include "gait/prior/build_prior.h"

namespace walktrack {
inline namespace gait {
namespace {

// Kuo (2002), level, toe-off and hip spring (configs/models/kuo_level_spring.yaml).
constexpr GaitTarget kStraightSeedTarget{0.420876, 0.420876 * 1.5744242, 0};
StraightGaitVector straight_seed_gait() {
  StraightGaitVector gait;
  gait << 0.1, 0.1, 0.335708232, 0.512001304, 0.393117244;
  return gait;
}

class StraightBuilder {
 public:
  explicit StraightBuilder(const StraightPriorGrid& grid) : effort_(grid.effort) {
    static_cast<PriorAxes&>(prior_) = grid;
    prior_.nodes.resize(prior_.size());
  }

  StraightPrior build(const std::function<bool(size_t)>& progress) {
    // The two families differ most on a slope, so that the first node is there.
    const Index first{nearest_index(prior_.speeds, kStraightSeedTarget.speed),
                      nearest_index(prior_.ratios, 1), prior_.slopes.size() / 2};
    solve(first, straight_seed_gait(), kStraightSeedTarget);
    for (size_t i = 0; i < queue_.size(); ++i) {
      const Index n = queue_[i];
      if (progress && !progress(i + 1)) break;
      for (const Index& m : neighbours(n))
        if (!node(m).cyclic) solve(m, node(n).gait, target(n));
    }
    fill(first);
    return std::move(prior_);
  }

 private:
  struct Index {
    size_t speed, ratio, slope;
  };

  StraightNode& node(const Index& n) { return prior_.nodes[prior_.at(n.speed, n.ratio, n.slope)]; }
  GaitTarget target(const Index& n) const { return prior_.target(n.speed, n.ratio, n.slope); }

  void solve(const Index& n, const StraightGaitVector& from, const GaitTarget& at) {
    const auto found = continued(from, at, target(n), find_straight_cycle);
    if (!found) return;
    node(n) = measured_node(*found, target(n), effort_);
    if (node(n).cyclic) queue_.push_back(n);
  }

  // Slopes before step lengths before speeds.
  std::vector<Index> neighbours(const Index& n) const {
    std::vector<Index> result;
    const auto add = [&](size_t Index::*axis, size_t size) {
      for (const size_t by : {size_t{0}, size_t{2}}) {  // one before, one after
        const size_t place = n.*axis + by;
        if (place == 0 || place > size) continue;
        result.push_back(n);
        result.back().*axis = place - 1;
      }
    };
    add(&Index::slope, prior_.slopes.size());
    add(&Index::ratio, prior_.ratios.size());
    add(&Index::speed, prior_.speeds.size());
    return result;
  }

  // Nodes without a cycle take the gait of a solved neighbour, outwards, so that the table has no
  // gaps.
  void fill(const Index& first) {
    if (queue_.empty()) queue_.push_back(first);
    std::vector<char> known(prior_.size());
    const auto at = [&](const Index& n) { return prior_.at(n.speed, n.ratio, n.slope); };
    for (const Index& n : queue_) known[at(n)] = 1;
    for (size_t i = 0; i < queue_.size(); ++i)
      for (const Index& m : neighbours(queue_[i])) {
        if (known[at(m)]) continue;
        known[at(m)] = 1;
        node(m) = node(queue_[i]);
        node(m).cyclic = node(m).valid = false;
        queue_.push_back(m);
      }
  }

  const double effort_;
  StraightPrior prior_;
  std::vector<Index> queue_;  // solved nodes, in order
};

}  // namespace

StraightPriorGrid::StraightPriorGrid() {
  const PriorGrid kneed;
  speeds = kneed.speeds;
  ratios = kneed.ratios;
  slopes = {0, 0.02, 0.04, 0.06, 0.08};
}

StraightNode measured_node(const StraightGaitVector& cycle, const GaitTarget& target,
                           double effort) {
  const StraightModel model = straight_unit_model(target.slope);
  StraightNode node;
  node.gait = cycle;
  const auto step = straight_step(model, cycle);
  const auto jacobian = cycle_jacobian(model, cycle);
  if (!step || !jacobian) return node;
  const auto& j = *jacobian;
  constexpr int kC = kStraightControlSize, kS = kStraightSectionSize;
  node.gain = regulator_gain(
      {step_matrix(j), j.block<kS, kC>(0, 0), j.block<2, kS>(kS, kC), j.block<2, kC>(kS, 0)},
      effort);
  node.multiplier = largest_multiplier(j);
  node.cost_of_transport = step->toe_off_work / step->advance;  // weight 1
  node.least_normal = step->least_normal;
  node.cyclic = cycle_residual(cycle, *step, target).norm() < 1e-6;
  node.valid = node.cyclic && cycle[0] >= 0 && cycle[1] >= 0 && step->least_normal > 0 &&
               step->old_foot_lifts;
  return node;
}

StraightPrior build_straight_prior(const StraightPriorGrid& grid,
                                   const std::function<bool(size_t)>& progress) {
  return StraightBuilder(grid).build(progress);
}

}  // namespace gait
}  // namespace walktrack
