#include "gait/survival.h"

#include <algorithm>

#include "core/parallel_for.h"

namespace walktrack {

double walking_time(const KneedModel& model, const PriorGait& gait, const SurvivalTrial& trial,
                    uint32_t walker, double longest) {
  Rng rng(trial.seed, Purpose::kControls, 0, walker);
  KneedState state = state_at_phase(model, gait, rng.uniform());
  KneedControls controls = draw_controls(rng, gait.controls, trial.noise);
  double time = 0;
  while (time < longest) {
    const double piece = std::min(trial.torque_step, longest - time);
    const Vector5 torque = draw_torques(rng, gait.units, trial.noise, piece);
    double left = piece;
    while (left > 0) {
      const KneedAdvance run = kneed_advance(model, controls, torque, state, left);
      left -= run.elapsed;
      if (run.event == KneedEvent::kNone) break;
      if (run.event != KneedEvent::kTransfer) return time + piece - left;
      controls = draw_controls(rng, next_controls(gait, state, trial.feedback), trial.noise);
    }
    time += piece;
  }
  return longest;
}

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
  parallel_for(trial.walkers, threads, [&](size_t i) {
    fell[i] = walking_time(model, gait, trial, static_cast<uint32_t>(i), times.back());
  });
  std::vector<double> shares;
  for (const double time : times) {
    const auto alive = std::count_if(fell.begin(), fell.end(), [&](double t) { return t >= time; });
    shares.push_back(static_cast<double>(alive) / static_cast<double>(trial.walkers));
  }
  return shares;
}

}  // namespace walktrack
