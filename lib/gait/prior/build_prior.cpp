#include "gait/prior/build_prior.h"

#include <algorithm>
#include <cmath>

#include "core/parallel_for.h"

namespace walktrack {
inline namespace gait {
namespace {

// An optimal gait at 1.25 m/s and steps of 0.694 m of an adult, from which the search begins. It
// was continued from a published cycle of the kneed walker (tests/walker/kneed_cycles.yaml).
constexpr GaitTarget kSeedTarget{1.25 / 3.01593, 0.694 / 0.9275, 0};
GaitVector seed_gait() {
  GaitVector gait;
  gait << 0.76039, 0.45542, 0.01827, 0.29539, 0.00979, 0.25560, 0.32594, 0.40867, 0.47755, -0.00860,
      0.10199, 0.07870, 0.10622, -0.02314, -0.27179, 0.36442, -0.11100, 0.30459, 0.25379, 0.73905,
      0.47850;
  return gait;
}

struct Index {
  size_t speed, ratio, slope;
};

size_t distance(size_t a, size_t b) { return a > b ? a - b : b - a; }

class Builder {
 public:
  Builder(const PriorGrid& grid, const GaitPrior& earlier) : grid_(grid) {
    prior_.speeds = grid.speeds;
    prior_.ratios = grid.ratios;
    prior_.slopes = grid.slopes;
    prior_.nodes.resize(prior_.size());
    solved_.assign(prior_.size(), 0);
    centre_ = {nearest_index(grid.speeds, kSeedTarget.speed), nearest_index(grid.ratios, 1),
               nearest_index(grid.slopes, 0)};
    for_each_node([&](const Index& n) { adopt(n, earlier); });
  }

  const GaitPrior& prior() const { return prior_; }
  size_t rings() const { return grid_.speeds.size() + grid_.ratios.size() + grid_.slopes.size(); }

  size_t solve_ring(size_t ring, int threads) {
    std::vector<Index> members;
    for_each_node([&](const Index& n) {
      if (from_centre(n) == ring) members.push_back(n);
    });
    parallel_for(members.size(), threads, [&](size_t i) { solve(members[i]); });
    return members.size();
  }

  // Nodes without a cycle extrapolate the lines of their neighbours, outwards from the cycles, so
  // that the table has no gaps.
  void fill() {
    std::vector<char> known = solved_;
    for (bool grown = true; grown;) {
      grown = false;
      const std::vector<char> before = known;
      for_each_node([&](const Index& n) {
        if (before[at(n)] || !fill(n, before)) return;
        known[at(n)] = 1;
        grown = true;
      });
    }
  }

  // Optimises every node once more, in two colours so that no node reads what another thread
  // writes.
  void sweep(int threads) {
    for (const size_t colour : {0u, 1u}) {
      std::vector<Index> members;
      for_each_node([&](const Index& n) {
        if ((n.speed + n.ratio + n.slope) % 2 == colour) members.push_back(n);
      });
      parallel_for(members.size(), threads, [&](size_t i) { resolve(members[i]); });
    }
  }

 private:
  template <typename F>
  void for_each_node(const F& f) const {
    for (size_t i = 0; i < grid_.speeds.size(); ++i)
      for (size_t j = 0; j < grid_.ratios.size(); ++j)
        for (size_t k = 0; k < grid_.slopes.size(); ++k) f(Index{i, j, k});
  }

  void adopt(const Index& n, const GaitPrior& earlier) {
    const auto place = [](const std::vector<double>& axis, double value) {
      size_t i = 0;
      while (i < axis.size() && std::abs(axis[i] - value) > 1e-9) ++i;
      return i;
    };
    const Index m{place(earlier.speeds, grid_.speeds[n.speed]),
                  place(earlier.ratios, grid_.ratios[n.ratio]),
                  place(earlier.slopes, grid_.slopes[n.slope])};
    if (m.speed == earlier.speeds.size() || m.ratio == earlier.ratios.size() ||
        m.slope == earlier.slopes.size())
      return;
    const GaitNode& node = earlier.node(m.speed, m.ratio, m.slope);
    if (!node.valid) return;
    prior_.nodes[at(n)] = node;
    solved_[at(n)] = 1;
  }

  size_t at(const Index& n) const { return prior_.at(n.speed, n.ratio, n.slope); }

  size_t from_centre(const Index& n) const {
    return distance(n.speed, centre_.speed) + distance(n.ratio, centre_.ratio) +
           distance(n.slope, centre_.slope);
  }

  GaitTarget target(const Index& n) const { return prior_.target(n.speed, n.ratio, n.slope); }

  // Neighbours one step nearer to the centre.
  std::vector<Index> parents(const Index& n) const {
    std::vector<Index> result;
    const auto towards = [](size_t a, size_t b) { return a > b ? a - 1 : a + 1; };
    if (n.slope != centre_.slope)
      result.push_back({n.speed, n.ratio, towards(n.slope, centre_.slope)});
    if (n.ratio != centre_.ratio)
      result.push_back({n.speed, towards(n.ratio, centre_.ratio), n.slope});
    if (n.speed != centre_.speed)
      result.push_back({towards(n.speed, centre_.speed), n.ratio, n.slope});
    return result;
  }

  std::optional<GaitVector> first_guess(const Index& n) const {
    const GaitTarget to = target(n);
    if (from_centre(n) == 0) return continue_cycle(seed_gait(), kSeedTarget, to);
    for (const Index& parent : parents(n)) {
      if (!solved_[at(parent)]) continue;
      auto guess = continue_cycle(prior_.nodes[at(parent)].gait, target(parent), to);
      if (guess) return guess;
    }
    return std::nullopt;
  }

  // The neighbour of a node `by` nodes along an axis, if it exists.
  std::optional<Index> neighbour(Index n, size_t Index::*axis, int by) const {
    const size_t size = axis == &Index::speed   ? grid_.speeds.size()
                        : axis == &Index::ratio ? grid_.ratios.size()
                                                : grid_.slopes.size();
    const auto place = static_cast<std::ptrdiff_t>(n.*axis) + by;
    if (place < 0 || place >= static_cast<std::ptrdiff_t>(size)) return std::nullopt;
    n.*axis = static_cast<size_t>(place);
    return n;
  }

  // Mean of the linear extrapolations from the known sides; false if no side is known.
  bool fill(const Index& n, const std::vector<char>& known) {
    GaitNode filled;
    GaitVector sum = GaitVector::Zero();
    int count = 0;
    for (const auto axis : {&Index::speed, &Index::ratio, &Index::slope})
      for (const int side : {-1, 1}) {
        const auto near = neighbour(n, axis, side), far = neighbour(n, axis, 2 * side);
        if (!near || !known[at(*near)]) continue;
        filled = prior_.nodes[at(*near)];
        const bool line = far && known[at(*far)];
        sum += line ? GaitVector(2 * filled.gait - prior_.nodes[at(*far)].gait) : filled.gait;
        ++count;
      }
    if (count == 0) return false;
    filled.gait = sum / count;
    filled.cyclic = filled.valid = false;
    prior_.nodes[at(n)] = filled;
    return true;
  }

  void solve(const Index& n) {
    if (solved_[at(n)]) return;
    const auto guess = first_guess(n);
    if (!guess) return;
    const GaitTarget to = target(n);
    GaitSearch search = grid_.search;
    search.centre = *guess;
    const GaitVector best = optimal_gait(*guess, to, grid_.objective, search);
    prior_.nodes[at(n)] = measured_node(best, to, grid_.effort);
    solved_[at(n)] = 1;
  }

  std::vector<Index> solved_neighbours(const Index& n) const {
    std::vector<Index> result;
    for (const int side : {-1, 1})
      for (const auto axis : {&Index::slope, &Index::ratio, &Index::speed})
        if (const auto m = neighbour(n, axis, side); m && solved_[at(*m)]) result.push_back(*m);
    return result;
  }

  // The mean of opposite neighbours, which is the gait of the node in a smooth table; its own gait
  // if there are none.
  GaitVector smooth_centre(const Index& n) const {
    GaitVector sum = GaitVector::Zero();
    double count = 0;
    for (const auto axis : {&Index::speed, &Index::ratio, &Index::slope}) {
      const auto below = neighbour(n, axis, -1), above = neighbour(n, axis, 1);
      if (!below || !above || !solved_[at(*below)] || !solved_[at(*above)]) continue;
      sum += 0.5 * (prior_.nodes[at(*below)].gait + prior_.nodes[at(*above)].gait);
      count += 1;
    }
    if (count > 0) return sum / count;
    const auto neighbours = solved_neighbours(n);
    if (solved_[at(n)] || neighbours.empty()) return prior_.nodes[at(n)].gait;
    return prior_.nodes[at(neighbours.front())].gait;
  }

  void resolve(const Index& n) {
    const GaitTarget to = target(n);
    const KneedModel model = unit_model(to);
    GaitSearch search = grid_.search;
    search.rounds = kSweepRounds;
    search.attraction = grid_.attraction;
    search.centre = smooth_centre(n);
    const auto value = [&](const GaitVector& gait) {
      return objective_value(model, grid_.objective, gait) +
             search.attraction * (gait - search.centre).squaredNorm();
    };
    std::optional<GaitVector> best;
    double least = kUnwalkable;
    const auto consider = [&](const std::optional<GaitVector>& guess) {
      if (!guess) return;
      const double cost = value(*guess);
      if (cost >= least) return;
      least = cost;
      best = guess;
    };
    if (solved_[at(n)]) consider(prior_.nodes[at(n)].gait);
    consider(find_cycle(model, search.centre, to));
    for (const Index& m : solved_neighbours(n))
      consider(continue_cycle(prior_.nodes[at(m)].gait, target(m), to));
    if (!best) return;
    const GaitVector gait = optimal_gait(*best, to, grid_.objective, search);
    prior_.nodes[at(n)] = measured_node(gait, to, grid_.effort);
    solved_[at(n)] = 1;
  }

  static constexpr int kSweepRounds = 2;  // of an optimisation in a sweep; by hand
  const PriorGrid& grid_;
  GaitPrior prior_;
  std::vector<char> solved_;
  Index centre_{};
};

}  // namespace

GaitNode measured_node(const GaitVector& cycle, const GaitTarget& target, double effort) {
  const KneedModel model = unit_model(target);
  GaitNode node;
  node.gait = cycle;
  const auto step = step_of(model, cycle);
  const auto jacobian = cycle_jacobian(model, cycle);
  if (!step || !jacobian) return node;
  const StepMeasures& m = step->measures;
  node.gain = feedback_gain(*jacobian, effort);
  node.cost_of_transport = cost_of_transport(cycle, *step);
  node.clearance = m.clearance;
  node.swing_flexion = m.swing_flexion;
  node.stance_flexion = m.stance_flexion;
  node.multiplier = multipliers(step_matrix(*jacobian))[0];
  const ValidGait limits;
  node.cyclic = cycle_residual(cycle, *step, target).norm() < 1e-6;
  node.valid = node.cyclic && m.clearance >= limits.least_clearance &&
               m.swing_flexion >= limits.least_swing_flexion &&
               m.swing_flexion <= limits.most_swing_flexion &&
               m.stance_flexion <= limits.most_stance_flexion;
  return node;
}

GaitPrior build_gait_prior(const PriorGrid& grid, const GaitPrior& earlier, int threads,
                           const PriorProgress& progress) {
  Builder builder(grid, earlier);
  size_t tried = 0;
  for (size_t ring = 0; ring < builder.rings(); ++ring) {
    const size_t members = builder.solve_ring(ring, threads);
    if (members == 0) break;
    tried += members;
    if (!progress(builder.prior(), tried)) return builder.prior();
  }
  for (int i = 0; i < grid.sweeps; ++i) {
    builder.sweep(threads);
    if (!progress(builder.prior(), tried)) return builder.prior();
  }
  builder.fill();
  return builder.prior();
}

}  // namespace gait
}  // namespace walktrack
