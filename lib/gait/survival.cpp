#include "gait/survival.h"

#include <algorithm>
#include <span>

#include "core/parallel_for.h"
#include "walker/kneed/kneed_batch.h"

namespace walktrack {
inline namespace gait {
namespace {

// Walkers that are advanced together: many vectors, and still enough groups for every thread.
constexpr size_t kGroup = 64;

// Common names for what the two walkers call differently.
struct KneedCrowd {
  using Gait = PriorGait;
  using State = KneedState;
  using Controls = KneedControls;
  using Torque = Vector5;
  using Run = KneedAdvance;
  KneedModel model;

  static Torque torque(Rng& rng, const Gait& gait, const GaitNoise& noise, double piece) {
    return draw_torques(rng, gait.units, noise, piece);
  }
  void advance(std::span<const Controls> controls, std::span<const Torque> torques,
               std::span<const double> left, std::span<State> states, std::span<Run> runs) const {
    kneed_advance_batch(model, controls, torques, left, states, runs);
  }
};

struct StraightCrowd {
  using Gait = StraightGait;
  using State = StraightState;
  using Controls = StraightControls;
  using Torque = Vector2;
  using Run = StraightAdvance;
  StraightModel model;

  static Torque torque(Rng& rng, const Gait& gait, const GaitNoise& noise, double piece) {
    return draw_hip_torque(rng, gait.units, noise, piece);
  }
  void advance(std::span<const Controls> controls, std::span<const Torque> torques,
               std::span<const double> left, std::span<State> states, std::span<Run> runs) const {
    straight_advance_batch(model, controls, torques, left, states, runs);
  }
};

template <typename Crowd>
struct Walkers {
  std::vector<Rng> rngs;
  std::vector<typename Crowd::State> states;
  std::vector<typename Crowd::Controls> controls;
  std::vector<typename Crowd::Torque> torques;
  std::vector<typename Crowd::Run> runs;
  std::vector<double> left;  // s, of the present interval
  std::vector<double> fell;  // s, time of the fall
};

template <typename Crowd>
Walkers<Crowd> starting_walkers(const Crowd& crowd, const typename Crowd::Gait& gait,
                                const SurvivalTrial& trial, size_t first, size_t count) {
  Walkers<Crowd> w;
  for (size_t i = first; i < first + count; ++i) {
    Rng rng(trial.seed, Purpose::kControls, 0, static_cast<uint32_t>(i));
    w.states.push_back(state_at_phase(crowd.model, gait, rng.uniform()));
    w.controls.push_back(draw_controls(rng, gait.controls, trial.noise));
    w.rngs.push_back(rng);
  }
  w.torques.resize(count);
  w.runs.resize(count);
  w.left.resize(count);
  w.fell.assign(count, -1);  // not yet
  return w;
}

// Advances all walkers with time left to the end of the interval or to their fall.
template <typename Crowd>
void walk_piece(const Crowd& crowd, const typename Crowd::Gait& gait, const SurvivalTrial& trial,
                double end, Walkers<Crowd>& w) {
  const auto has_time = [](double left) { return left > 0; };
  while (std::any_of(w.left.begin(), w.left.end(), has_time)) {
    crowd.advance(w.controls, w.torques, w.left, w.states, w.runs);
    for (size_t i = 0; i < w.runs.size(); ++i) {
      if (!has_time(w.left[i])) continue;
      w.left[i] -= w.runs[i].elapsed;
      switch (w.runs[i].event) {
        case KneedEvent::kNone:
          w.left[i] = 0;
          break;
        case KneedEvent::kTransfer:
          w.controls[i] = draw_controls(w.rngs[i], next_controls(gait, w.states[i], trial.feedback),
                                        trial.noise);
          break;
        case KneedEvent::kFallen:
        case KneedEvent::kDiverged:
          w.fell[i] = end - w.left[i];
          w.left[i] = 0;
      }
    }
  }
}

// The time at which each of `count` walkers fell, s, or `longest`.
template <typename Crowd>
std::vector<double> walking_times(const Crowd& crowd, const typename Crowd::Gait& gait,
                                  const SurvivalTrial& trial, size_t first, size_t count,
                                  double longest) {
  Walkers<Crowd> w = starting_walkers(crowd, gait, trial, first, count);
  for (double time = 0; time < longest; time += trial.torque_step) {
    const double piece = std::min(trial.torque_step, longest - time);
    for (size_t i = 0; i < count; ++i) {
      w.left[i] = w.fell[i] < 0 ? piece : 0;
      if (w.left[i] > 0) w.torques[i] = Crowd::torque(w.rngs[i], gait, trial.noise, piece);
    }
    walk_piece(crowd, gait, trial, time + piece, w);
  }
  for (double& time : w.fell)
    if (time < 0) time = longest;
  return w.fell;
}

template <typename Crowd>
std::vector<double> survival_of(const Crowd& crowd, const typename Crowd::Gait& gait,
                                const SurvivalTrial& trial, const std::vector<double>& times,
                                int threads) {
  std::vector<double> fell(trial.walkers);
  parallel_for((trial.walkers + kGroup - 1) / kGroup, threads, [&](size_t group) {
    const size_t first = group * kGroup, count = std::min(kGroup, trial.walkers - first);
    const auto times_of_group = walking_times(crowd, gait, trial, first, count, times.back());
    std::copy(times_of_group.begin(), times_of_group.end(),
              fell.begin() + static_cast<std::ptrdiff_t>(first));
  });
  std::vector<double> shares;
  for (const double time : times) {
    const auto alive = std::count_if(fell.begin(), fell.end(), [&](double t) { return t >= time; });
    shares.push_back(static_cast<double>(alive) / static_cast<double>(trial.walkers));
  }
  return shares;
}

template <typename Prior, typename Parameters>
auto gait_of(const Prior& prior, const Parameters& parameters, const SurvivalTrial& trial) {
  const WalkerUnits units = walker_units(parameters);
  const double step = trial.step_length > 0
                          ? trial.step_length
                          : units.length * preferred_step_length(trial.speed / units.speed());
  return gait_at(prior, parameters, trial.speed, step);
}

}  // namespace

std::vector<double> survival(const GaitPrior& prior, const KneedParameters& parameters,
                             const SurvivalTrial& trial, const std::vector<double>& times,
                             int threads) {
  return survival_of(KneedCrowd{kneed_model(parameters)}, gait_of(prior, parameters, trial), trial,
                     times, threads);
}

std::vector<double> survival(const StraightPrior& prior, const StraightLeggedParameters& parameters,
                             const SurvivalTrial& trial, const std::vector<double>& times,
                             int threads) {
  return survival_of(StraightCrowd{straight_model(parameters)}, gait_of(prior, parameters, trial),
                     trial, times, threads);
}

}  // namespace gait
}  // namespace walktrack
