#include "gait/survival.h"

#include <algorithm>

#include "core/parallel_for.h"
#include "walker/kneed_batch.h"

namespace walktrack {
namespace {

// Walkers that go together: many vectors, and still enough groups for every thread.
constexpr size_t kGroup = 64;

struct Walkers {
  std::vector<Rng> rngs;
  std::vector<KneedState> states;
  std::vector<KneedControls> controls;
  std::vector<Vector5> torques;
  std::vector<double> left;  // s, of the present piece of time
  std::vector<double> fell;  // s
};

Walkers starting_walkers(const KneedModel& model, const PriorGait& gait, const SurvivalTrial& trial,
                         size_t first, size_t count) {
  Walkers w;
  for (size_t i = first; i < first + count; ++i) {
    Rng rng(trial.seed, Purpose::kControls, 0, static_cast<uint32_t>(i));
    w.states.push_back(state_at_phase(model, gait, rng.uniform()));
    w.controls.push_back(draw_controls(rng, gait.controls, trial.noise));
    w.rngs.push_back(rng);
  }
  w.torques.resize(count);
  w.left.resize(count);
  w.fell.assign(count, -1);  // not yet
  return w;
}

// Moves all who have time left to its end or to their fall; `end` is when the piece ends.
void walk_piece(const KneedModel& model, const PriorGait& gait, const SurvivalTrial& trial,
                double end, Walkers& w, std::vector<KneedAdvance>& runs) {
  const auto has_time = [](double left) { return left > 0; };
  while (std::any_of(w.left.begin(), w.left.end(), has_time)) {
    kneed_advance_batch(model, w.controls, w.torques, w.left, w.states, runs);
    for (size_t i = 0; i < runs.size(); ++i) {
      if (!has_time(w.left[i])) continue;
      w.left[i] -= runs[i].elapsed;
      switch (runs[i].event) {
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

// When each of `count` walkers fell, s, or `longest`.
std::vector<double> walking_times(const KneedModel& model, const PriorGait& gait,
                                  const SurvivalTrial& trial, size_t first, size_t count,
                                  double longest) {
  Walkers w = starting_walkers(model, gait, trial, first, count);
  std::vector<KneedAdvance> runs(count);
  for (double time = 0; time < longest; time += trial.torque_step) {
    const double piece = std::min(trial.torque_step, longest - time);
    for (size_t i = 0; i < count; ++i) {
      w.left[i] = w.fell[i] < 0 ? piece : 0;
      if (w.left[i] > 0) w.torques[i] = draw_torques(w.rngs[i], gait.units, trial.noise, piece);
    }
    walk_piece(model, gait, trial, time + piece, w, runs);
  }
  for (double& time : w.fell)
    if (time < 0) time = longest;
  return w.fell;
}

}  // namespace

std::vector<double> survival(const GaitPrior& prior, const KneedParameters& parameters,
                             const SurvivalTrial& trial, const std::vector<double>& times,
                             int threads) {
  const WalkerUnits units = walker_units(parameters);
  const double step = trial.step_length > 0
                          ? trial.step_length
                          : units.length * preferred_step_length(trial.speed / units.speed());
  const PriorGait gait = gait_at(prior, parameters, trial.speed, step);
  const KneedModel model = kneed_model(parameters);
  std::vector<double> fell(trial.walkers);
  parallel_for((trial.walkers + kGroup - 1) / kGroup, threads, [&](size_t group) {
    const size_t first = group * kGroup, count = std::min(kGroup, trial.walkers - first);
    const auto times_of_group = walking_times(model, gait, trial, first, count, times.back());
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

}  // namespace walktrack
