// Sequential importance resampling with tempered layers and moves.
//
// One frame: every particle is propagated, then weighted by its likelihood L. Where the likelihood
// is sharp, it is brought in by layers 0 < b_1 < ... < b_K = 1, chosen so that the effective sample
// size of each increment L^(b_k - b_(k-1)) stays at `layer_ess`; between layers the set is
// resampled and moved by Metropolis-Hastings steps that leave prior * L^b_k invariant, so layers
// spread particles over the posterior without changing it (Del Moral, Doucet & Jasra, "Sequential
// Monte Carlo samplers", JRSS B 68, 2006; adaptive exponents as in Deutscher & Reid, "Articulated
// body motion capture by stochastic search", IJCV 61, 2005). With `max_layers` = 1 and `moves` = 0
// it is the plain bootstrap filter (Gordon, Salmond & Smith 1993).
//
// The filter is independent of walkers and images. Its model consists of three callables, each a
// pure function of its arguments (so that the result does not depend on threads):
//   propagate(state, index)            one frame forward, noise drawn; false = the particle died
//   log_likelihood(state)              of this frame's evidence, any finite value: a double, or by
//                                      stages (StagedLikelihood)
//   move(state, scale, rng)            proposes a change in place, reversible with respect to the
//                                      prior of this frame; scale in (0, 1] is its step_size,
//                                      adapted from layer to layer towards the acceptance of
//                                      kWantedAcceptance
// A dead particle has the weight -infinity until resampling replaces it. If all particles are dead,
// this is reported, and the caller must start again.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "core/log_weights.h"
#include "core/parallel_for.h"
#include "core/rng.h"
#include "filter/resampling.h"

namespace walktrack {
inline namespace filter {

// A likelihood that is a product of factors which are computed one after the other. A move is
// tested with each of them in turn and rejected by the first one without computing the others:
// delayed acceptance (Christen & Fox, "Markov chain Monte Carlo using an approximation", JCGS 14,
// 2005; Banterle, Grazian, Lee & Robert, "Accelerating Metropolis-Hastings algorithms by delayed
// acceptance", 2019). It leaves the same distribution invariant, with fewer moves accepted.
inline constexpr int kMaxStages = 2;

template <typename L, typename State>
concept StagedLikelihood = requires(const L& likelihood, const State& state) {
  { likelihood.stages() } -> std::convertible_to<int>;      // from 1 to kMaxStages
  { likelihood(state)(0) } -> std::convertible_to<double>;  // of stage 0
};

struct FilterConfig {
  int particles = 200;
  double resample_below = 0.5;  // resample when ESS / particles falls below this
  double layer_ess = 0.5;       // ESS after each increment of the exponent / ESS before it
  int max_layers = 8;           // the last layer takes the rest of the exponent
  int moves = 4;                // Metropolis-Hastings steps for each particle and layer
};

template <typename State>
struct ParticleSet {
  std::vector<State> states;
  std::vector<double> log_weights;
  std::vector<double> log_likelihoods;  // of the present frame
};

// Everything on which a filter's next frame depends.
template <typename State>
struct FilterState {
  ParticleSet<State> set;
  double scale = 0;  // step_size of the moves
};

struct FilterReport {
  double log_evidence = 0;  // log p(this frame | frames before), estimated
  double ess = 0;           // before the last resampling of the frame, in particles
  int layers = 0;
  int dead = 0;           // particles that died in the propagation or have zero likelihood
  double accepted = 0;    // share of moves accepted, 0 when there were none
  bool all_dead = false;  // every weight is -infinity: start anew
};

template <typename State>
class ParticleFilter {
 public:
  ParticleFilter(FilterConfig config, uint64_t seed, int threads)
      : config_(config), seed_(seed), threads_(threads) {}

  const ParticleSet<State>& particles() const { return set_; }

  // Starts anew from equally weighted states.
  void start(std::vector<State> states) {
    set_.log_weights.assign(states.size(), 0.0);
    set_.log_likelihoods.assign(states.size(), 0.0);
    set_.states = std::move(states);
  }

  // A filter that takes the state of another one with the same configuration and seed continues in
  // the same way.
  FilterState<State> state() const { return {set_, scale_}; }
  void resume(FilterState<State> state) {
    set_ = std::move(state.set);
    scale_ = state.scale;
  }

  template <typename Propagate, typename LogLikelihood, typename Move>
  FilterReport step(uint32_t frame, const Propagate& propagate, const LogLikelihood& log_likelihood,
                    const Move& move) {
    predict(propagate);
    return update(frame, log_likelihood, move);
  }

  // The first half of a frame: the set becomes the prediction.
  template <typename Propagate>
  void predict(const Propagate& propagate) {
    predict_groups(1, [&](size_t i, std::span<State> state, std::span<uint8_t> alive) {
      alive[0] = propagate(state[0], static_cast<uint32_t>(i)) ? 1 : 0;
    });
  }

  // The same for states that are faster to propagate in groups: propagate(first, states, alive)
  // takes `group` of them (or fewer at the end), of which states[0] is number `first`, and sets
  // which ones are alive. The result for a state must not depend on the groups.
  template <typename Propagate>
  void predict_groups(size_t group, const Propagate& propagate) {
    alive_.resize(size());
    parallel_for((size() + group - 1) / group, threads_, [&](size_t g) {
      const size_t first = g * group, count = std::min(group, size() - first);
      propagate(first, std::span(set_.states).subspan(first, count),
                std::span(alive_).subspan(first, count));
    });
    before_ = log_sum_exp(set_.log_weights);
    for (size_t i = 0; i < size(); ++i)
      if (!alive_[i]) set_.log_weights[i] = kDead;
  }

  // The second half: the prediction is weighted with the frame's evidence.
  template <typename LogLikelihood, typename Move>
  FilterReport update(uint32_t frame, const LogLikelihood& log_likelihood, const Move& move) {
    FilterReport report;
    Rng rng(seed_, Purpose::kResampling, frame);
    weigh(log_likelihood, report);
    // Also true if the particles that are alive in this frame had been dead before.
    if (log_sum_exp(set_.log_weights) == kDead) {
      report.all_dead = true;
      report.log_evidence = kDead;
      return report;
    }
    double exponent = 0;
    for (report.layers = 1;; ++report.layers) {
      const bool last = report.layers >= config_.max_layers;
      exponent += temper(last ? 1.0 - exponent : increment(1.0 - exponent), report);
      if (exponent >= 1.0) break;
      resample(rng.uniform());
      move_all(frame, exponent, report.layers, log_likelihood, move);
    }
    report.ess = effective_sample_size(set_.log_weights);
    if (report.ess < config_.resample_below * static_cast<double>(size())) {
      resample(rng.uniform());
      move_all(frame, exponent, report.layers, log_likelihood, move);
    }
    if (proposed_ > 0) report.accepted = double(accepted_) / double(proposed_);
    return report;
  }

 private:
  static constexpr double kDead = -std::numeric_limits<double>::infinity();
  // Random-walk proposals in many dimensions are most efficient near this rate (Roberts, Gelman &
  // Gilks 1997 derive .234; for blocks of few dimensions a higher rate is better).
  static constexpr double kWantedAcceptance = 0.3;
  static constexpr double kMinStepSize = 0.02;

  size_t size() const { return set_.states.size(); }

  // A log-likelihood by its stages.
  using Stages = std::array<double, kMaxStages>;

  template <typename LogLikelihood>
  static int stages_of(const LogLikelihood& log_likelihood) {
    if constexpr (StagedLikelihood<LogLikelihood, State>) return log_likelihood.stages();
    return 1;
  }

  // Computes one stage after the other while `go_on(stage, value)` is true.
  template <typename LogLikelihood, typename GoOn>
  static bool ask(const LogLikelihood& log_likelihood, const State& state, const GoOn& go_on) {
    if constexpr (StagedLikelihood<LogLikelihood, State>) {
      const auto account = log_likelihood(state);
      for (int stage = 0; stage < stages_of(log_likelihood); ++stage)
        if (!go_on(static_cast<size_t>(stage), account(stage))) return false;
      return true;
    } else {
      return go_on(0, log_likelihood(state));
    }
  }

  static double sum(const Stages& stages) {
    return std::accumulate(stages.begin(), stages.end(), 0.0);
  }

  template <typename LogLikelihood>
  void weigh(const LogLikelihood& log_likelihood, FilterReport& report) {
    proposed_ = accepted_ = 0;
    stages_.assign(size(), Stages{});
    parallel_for(size(), threads_, [&](size_t i) {
      if (alive_[i])
        ask(log_likelihood, set_.states[i], [&](size_t stage, double value) {
          stages_[i][stage] = value;
          return true;
        });
      set_.log_likelihoods[i] = alive_[i] ? sum(stages_[i]) : kDead;
    });
    for (size_t i = 0; i < size(); ++i) {
      if (set_.log_likelihoods[i] != kDead) continue;
      set_.log_weights[i] = kDead;
      ++report.dead;
    }
    report.log_evidence = log_sum_exp(set_.log_weights) - before_;
  }

  // The largest step of the exponent, at most `room`, whose weights keep the wanted sample size.
  double increment(double room) const {
    const double wanted = config_.layer_ess * effective_sample_size(set_.log_weights);
    if (ess_after(room) >= wanted) return room;
    double low = 0, high = room;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (ess_after(middle) >= wanted ? low : high) = middle;
    }
    return high;  // > 0, so that layers always advance
  }

  double ess_after(double step) const {
    raised_.resize(size());
    for (size_t i = 0; i < size(); ++i) {
      const bool alive = set_.log_weights[i] != kDead;
      raised_[i] = alive ? set_.log_weights[i] + step * set_.log_likelihoods[i] : kDead;
    }
    return effective_sample_size(raised_);
  }

  double temper(double step, FilterReport& report) {
    const double before = log_sum_exp(set_.log_weights);
    for (size_t i = 0; i < size(); ++i) {
      if (set_.log_weights[i] != kDead) set_.log_weights[i] += step * set_.log_likelihoods[i];
    }
    const double after = log_sum_exp(set_.log_weights);
    report.log_evidence += after - before;
    // Only ratios matter; centring keeps the numbers small over many frames.
    for (double& w : set_.log_weights) w -= after;
    return step;
  }

  void resample(double u) {
    parents_.resize(size());
    systematic_resample(set_.log_weights, u, parents_);
    next_states_.resize(size());
    next_log_likelihoods_.resize(size());
    next_stages_.resize(size());
    parallel_for(size(), threads_, [&](size_t i) {
      next_states_[i] = set_.states[parents_[i]];
      next_log_likelihoods_[i] = set_.log_likelihoods[parents_[i]];
      next_stages_[i] = stages_[parents_[i]];
    });
    set_.states.swap(next_states_);
    set_.log_likelihoods.swap(next_log_likelihoods_);
    stages_.swap(next_stages_);
    set_.log_weights.assign(size(), -std::log(static_cast<double>(size())));
  }

  template <typename LogLikelihood, typename Move>
  void move_all(uint32_t frame, double exponent, int layer, const LogLikelihood& log_likelihood,
                const Move& move) {
    if (config_.moves == 0) return;
    accepted_by_.assign(size(), 0);
    parallel_for(size(), threads_, [&](size_t i) {
      Rng rng(seed_, Purpose::kMoves, frame,
              static_cast<uint32_t>(static_cast<size_t>(layer) * size() + i));
      for (int k = 0; k < config_.moves; ++k) {
        State proposal = set_.states[i];
        move(proposal, scale_, rng);
        Stages candidate{};
        const auto passes = [&](size_t stage, double value) {
          candidate[stage] = value;
          return std::log(rng.uniform()) < exponent * (value - stages_[i][stage]);
        };
        if (!ask(log_likelihood, proposal, passes)) continue;
        set_.states[i] = std::move(proposal);
        stages_[i] = candidate;
        set_.log_likelihoods[i] = sum(candidate);
        ++accepted_by_[i];
      }
    });
    adapt(std::accumulate(accepted_by_.begin(), accepted_by_.end(), 0L));
  }

  void adapt(long accepted) {
    const long proposed = static_cast<long>(size()) * config_.moves;
    const double share = static_cast<double>(accepted) / static_cast<double>(proposed);
    scale_ = std::clamp(scale_ * std::exp(share - kWantedAcceptance), kMinStepSize, 1.0);
    proposed_ += proposed;
    accepted_ += accepted;
  }

  FilterConfig config_;
  uint64_t seed_;
  int threads_;
  ParticleSet<State> set_;
  std::vector<uint8_t> alive_;  // survived the prediction
  double before_ = 0;           // log of the weights' sum before it
  std::vector<Stages> stages_;  // of the log-likelihoods
  std::vector<State> next_states_;
  std::vector<Stages> next_stages_;
  std::vector<double> next_log_likelihoods_;
  std::vector<uint32_t> parents_;
  std::vector<int> accepted_by_;  // moves accepted, by particle
  double scale_ = 0.4;            // step_size of the moves
  long proposed_ = 0, accepted_ = 0;
  mutable std::vector<double> raised_;
};

}  // namespace filter
}  // namespace walktrack
