#include "gait/walk_plan.h"

#include <algorithm>

namespace walktrack {

double wanted_speed(const WalkPlan& plan, double time) {
  double speed = plan.speed;
  for (size_t i = 0; i < plan.changes.size() && plan.changes[i].time < time; ++i) {
    const double until =
        i + 1 < plan.changes.size() ? std::min(time, plan.changes[i + 1].time) : time;
    const double most = plan.acceleration * (until - plan.changes[i].time);
    speed += std::clamp(plan.changes[i].speed - speed, -most, most);
  }
  return speed;
}

PriorGait planned_gait(const GaitPrior& prior, const KneedParameters& parameters,
                       const WalkPlan& plan, double time) {
  const double speed = wanted_speed(plan, time);
  const WalkerUnits units = walker_units(parameters);
  const double step = plan.step_length > 0
                          ? plan.step_length
                          : units.length * preferred_step_length(speed / units.speed());
  return gait_at(prior, parameters, speed, step);
}

}  // namespace walktrack
