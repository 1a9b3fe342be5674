// The filter compared with exact posteriors of a small nonlinear model, and its evidence with the
// exact one, over many runs.
//
// The model is the growth model of Gordon, Salmond & Smith 1993, whose observation does not
// distinguish x from -x, so that posteriors have two modes:
//   x' = x/2 + 25 x / (1 + x^2) + 8 cos(1.2 t) + sqrt(10) n,   y = x^2 / 20 + n
// Its exact filter is a sum over a fine grid.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "core/rng.h"
#include "filter/particle_filter.h"

namespace walktrack {
namespace {

// The prediction and the standardised noise on top, so that a move is reversible with respect to
// the prior.
struct GrowthState {
  double predicted = 0, noise = 0;
};
const double kProcess = std::sqrt(10.0);
constexpr double kStart = 2;  // deviation of the first state
double value(const GrowthState& s) { return s.predicted + kProcess * s.noise; }

double grown(double x, uint32_t t) { return x / 2 + 25 * x / (1 + x * x) + 8 * std::cos(1.2 * t); }
double log_normal(double z) { return -0.5 * z * z - 0.5 * std::log(2 * kPi); }
double log_seen(double y, double x) { return log_normal(y - x * x / 20); }

std::vector<double> observations(uint32_t frames, uint64_t seed) {
  Rng rng(seed, Purpose::kTest);
  double x = kStart * rng.normal();
  std::vector<double> y;
  for (uint32_t t = 0; t < frames; ++t) {
    x = grown(x, t) + kProcess * rng.normal();
    y.push_back(x * x / 20 + rng.normal());
  }
  return y;
}

// Exact up to the grid's resolution: a tenth of the narrowest scale.
class GridFilter {
 public:
  GridFilter() {
    for (size_t i = 0; i < kCells; ++i)
      mass_.push_back(std::exp(log_normal(x(i) / kStart)) * kStep / kStart);
  }
  // Returns the frame's log-evidence.
  double step(double y, uint32_t t) {
    std::vector<double> next(kCells, 0.0);
    for (size_t i = 0; i < kCells; ++i) {
      if (mass_[i] < 1e-14) continue;
      const double mean = grown(x(i), t);
      for (size_t j = 0; j < kCells; ++j)
        next[j] += mass_[i] * std::exp(log_normal((x(j) - mean) / kProcess)) * kStep / kProcess;
    }
    double evidence = 0;
    for (size_t j = 0; j < kCells; ++j) evidence += next[j] *= std::exp(log_seen(y, x(j)));
    for (size_t j = 0; j < kCells; ++j) mass_[j] = next[j] / evidence;
    return std::log(evidence);
  }
  double below(double bound) const {
    double sum = 0;
    for (size_t i = 0; i < kCells && x(i) < bound; ++i) sum += mass_[i];
    return sum;
  }

 private:
  static constexpr size_t kCells = 800;
  static constexpr double kStep = 0.1;
  static double x(size_t i) { return (static_cast<double>(i) - 0.5 * (kCells - 1)) * kStep; }
  std::vector<double> mass_;
};

class GrowthFilter {
 public:
  GrowthFilter(const FilterConfig& config, uint64_t seed) : seed_(seed), filter_(config, seed, 1) {
    std::vector<GrowthState> states;
    for (uint32_t i = 0; i < static_cast<uint32_t>(config.particles); ++i)
      states.push_back({kStart * Rng(seed, Purpose::kInitialisation, 0, i).normal(), 0});
    filter_.start(std::move(states));
  }
  double step(double y, uint32_t t) {
    const auto propagate = [&](GrowthState& s, uint32_t i) {
      s = {grown(value(s), t), Rng(seed_, Purpose::kTorque, t, i).normal()};
      return true;
    };
    const auto log_likelihood = [&](const GrowthState& s) { return log_seen(y, value(s)); };
    const auto move = [](GrowthState& s, double scale, Rng& rng) {
      s.noise = std::sqrt(1 - scale * scale) * s.noise + scale * rng.normal();
    };
    return filter_.step(t, propagate, log_likelihood, move).log_evidence;
  }
  double below(double bound) const {
    const auto& set = filter_.particles();
    const std::vector<double> weights = normalised_weights(set.log_weights);
    double sum = 0;
    for (size_t i = 0; i < weights.size(); ++i)
      sum += value(set.states[i]) < bound ? weights[i] : 0;
    return sum;
  }

 private:
  uint64_t seed_;
  ParticleFilter<GrowthState> filter_;
};

// Compares distribution functions at points all over both modes. `spread`: particles per effective
// one.
void expect_exact(const FilterConfig& config, double spread) {
  constexpr uint32_t kFrames = 20;
  const std::vector<double> y = observations(kFrames, 3);
  GridFilter exact;
  GrowthFilter filter(config, 4);
  double largest = 0;
  for (uint32_t t = 0; t < kFrames; ++t) {
    const double evidence = exact.step(y[t], t);
    EXPECT_NEAR(filter.step(y[t], t), evidence, 5 * std::sqrt(spread / config.particles)) << t;
    for (double bound = -20; bound <= 20; bound += 2.5) {
      const double share = std::min(1.0, exact.below(bound));
      // One grid cell further: the edge of the grid is not the limit.
      const double sigma = std::sqrt(share * (1 - share) * spread / config.particles);
      EXPECT_NEAR(filter.below(bound), share, 5 * sigma + 0.02) << t << ", below " << bound;
      largest = std::max(largest, std::min(share, 1 - share));
    }
  }
  EXPECT_GT(largest, 0.3);  // the modes were distinct
}

TEST(Posterior, OfTwoModesIsFoundByThePlainFilter) {
  expect_exact({.particles = 20000, .max_layers = 1, .moves = 0}, 30);
}

TEST(Posterior, OfTwoModesIsFoundByTemperingAndMoves) {
  expect_exact({.particles = 5000, .max_layers = 8, .moves = 3}, 30);
}

// The estimate of the evidence, not of its logarithm, is unbiased for any number of particles (Del
// Moral, "Feynman-Kac Formulae", 2004, theorem 7.4.2): its mean over runs is the exact one. With
// adaptive tempering this is not guaranteed, but a bias must not be visible.
void expect_unbiased(FilterConfig config, int runs) {
  constexpr uint32_t kFrames = 6;
  const std::vector<double> y = observations(kFrames, 5);
  GridFilter exact;
  double log_exact = 0;
  for (uint32_t t = 0; t < kFrames; ++t) log_exact += exact.step(y[t], t);
  std::vector<double> ratio;
  for (int run = 0; run < runs; ++run) {
    GrowthFilter filter(config, 100 + static_cast<uint64_t>(run));
    double log_found = 0;
    for (uint32_t t = 0; t < kFrames; ++t) log_found += filter.step(y[t], t);
    ratio.push_back(std::exp(log_found - log_exact));
  }
  const double mean = std::accumulate(ratio.begin(), ratio.end(), 0.0) / runs;
  double variance = 0;
  for (const double each : ratio) variance += (each - mean) * (each - mean) / (runs - 1);
  EXPECT_NEAR(mean, 1, 5 * std::sqrt(variance / runs));
  // The test is precise enough to see a bias of a tenth.
  EXPECT_LT(5 * std::sqrt(variance / runs), 0.1);
}

TEST(Evidence, OfThePlainFilterIsUnbiased) {
  expect_unbiased({.particles = 100, .max_layers = 1, .moves = 0}, 2000);
}

TEST(Evidence, OfTemperingAndMovesIsToo) {
  expect_unbiased({.particles = 100, .max_layers = 8, .moves = 2}, 600);
}

}  // namespace
}  // namespace walktrack
