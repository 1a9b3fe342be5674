// Laws of weights, resampling and the filter, for random inputs.
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/log_weights.h"
#include "filter/particle_filter.h"

namespace walktrack {
namespace {

constexpr double kDead = -std::numeric_limits<double>::infinity();

// Log-weights of all magnitudes that images give, some of them dead.
std::vector<double> some_log_weights() {
  const auto weight = rc::gen::oneOf(
      rc::gen::just(kDead), rc::gen::map(rc::gen::inRange(-50, 50), [](int w) { return 0.2 * w; }),
      rc::gen::map(rc::gen::inRange(-1000, 1000), [](int w) { return 1e3 * w; }));
  return *rc::gen::nonEmpty(rc::gen::container<std::vector<double>>(weight));
}

bool all_dead(const std::vector<double>& log_weights) {
  return std::all_of(log_weights.begin(), log_weights.end(), [](double w) { return w == kDead; });
}

RC_GTEST_PROP(LogWeightsLaw, NormaliseToOneAndCountBetweenOneAndAll, ()) {
  const std::vector<double> w = some_log_weights();
  const std::vector<double> p = normalised_weights(w);
  const double sum = std::accumulate(p.begin(), p.end(), 0.0), ess = effective_sample_size(w);
  const auto alive = static_cast<double>(w.size() - size_t(std::count(w.begin(), w.end(), kDead)));
  // A logarithm of 1e6 is rounded by 1e-10, which is the relative error of the weights.
  RC_ASSERT(std::abs(sum - (alive > 0 ? 1 : 0)) < 1e-9);
  RC_ASSERT(ess <= alive * (1 + 1e-9));
  RC_ASSERT(alive == 0 || ess >= 1 - 1e-9);
}

RC_GTEST_PROP(ResamplingLaw, CountsAreExpectedOnesRoundedAndTheDeadAreNeverChosen, ()) {
  const std::vector<double> w = some_log_weights();
  const double u = *rc::gen::inRange(1, 1000) / 1000.0;
  std::vector<uint32_t> parents(*rc::gen::inRange<size_t>(1, 200));
  RC_ASSERT(systematic_resample(w, u, parents) == !all_dead(w));
  if (all_dead(w)) return;
  RC_ASSERT(std::is_sorted(parents.begin(), parents.end()));
  const std::vector<double> p = normalised_weights(w);
  const auto n = static_cast<double>(parents.size());
  for (size_t i = 0; i < w.size(); ++i) {
    const auto count = std::count(parents.begin(), parents.end(), static_cast<uint32_t>(i));
    RC_ASSERT(w[i] != kDead || count == 0);
    RC_ASSERT(std::abs(static_cast<double>(count) - n * p[i]) < 1 + 1e-9);
  }
}

// A filter in one dimension with a piecewise constant likelihood: any finite values, or zero.
struct Steps {
  std::vector<double> heights;
  double operator()(double x) const {
    const auto at = static_cast<long>(std::floor(x)) % static_cast<long>(heights.size());
    return heights[static_cast<size_t>(at < 0 ? at + static_cast<long>(heights.size()) : at)];
  }
};

class Line {
 public:
  Line(const FilterConfig& config, int threads) : filter_(config, 7, threads) {
    filter_.start(std::vector<double>(static_cast<size_t>(config.particles), 0.0));
  }
  FilterReport step(uint32_t frame, const Steps& likelihood) {
    return filter_.step(
        frame,
        [frame](double& x, uint32_t i) {
          Rng rng(3, Purpose::kTest, frame, i);
          x += 2 * rng.normal();
          return rng.uniform() > 0.1;  // one in ten dies
        },
        likelihood, [](double& x, double scale, Rng& rng) { x += scale * rng.normal(); });
  }
  ParticleFilter<double>& filter() { return filter_; }
  bool operator==(const Line& other) const {
    const auto &a = filter_.particles(), &b = other.filter_.particles();
    return a.states == b.states && a.log_weights == b.log_weights;
  }

 private:
  ParticleFilter<double> filter_;
};

FilterConfig some_config() {
  return {.particles = *rc::gen::inRange(1, 60),
          .resample_below = *rc::gen::inRange(0, 11) / 10.0,
          .layer_ess = *rc::gen::inRange(0, 11) / 10.0,
          .max_layers = *rc::gen::inRange(1, 6),
          .moves = *rc::gen::inRange(0, 3)};
}

RC_GTEST_PROP(FilterLaw, NeverANumberThatIsNoneForAnyThreadsAndFromAnyState, ()) {
  const FilterConfig config = some_config();
  const Steps likelihood{some_log_weights()};
  Line one(config, 1), two(config, 2), resumed(config, 1);
  for (uint32_t frame = 0; frame < 3; ++frame) {
    const FilterReport report = one.step(frame, likelihood);
    two.step(frame, likelihood);
    RC_ASSERT(one == two);
    RC_ASSERT(!std::isnan(report.log_evidence));
    RC_ASSERT(report.all_dead == (report.log_evidence == kDead));
    if (report.all_dead) return;
    RC_ASSERT(report.ess >= 1 - 1e-9);
    RC_ASSERT(report.ess <= config.particles * (1 + 1e-9));
    RC_ASSERT(report.accepted >= 0 && report.accepted <= 1);
    // Another filter that takes the state continues to the same particles.
    resumed.filter().resume(one.filter().state());
    Line same = one;
    same.step(frame + 1, likelihood);
    resumed.step(frame + 1, likelihood);
    RC_ASSERT(same == resumed);
  }
}

}  // namespace
}  // namespace walktrack
