#include "gait/walk_plan.h"

#include <algorithm>

namespace walktrack {
namespace {

// Distances of sections, in units L = M = g = 1: from the gait aimed at, and between two transfers,
// up to which a walker may be slowed down. The table's gaits are 0.05 to 0.25 apart for 0.1 m/s; on
// slopes between its nodes a walker settles up to 0.4 from the interpolated gait, so that the first
// alone would hold it for ever. Of 84 changes between seven speeds on the level and 6 % uphill none
// falls, of 42 downhill two to 0.5 m/s do.
constexpr double kLag = 0.15;
constexpr double kSettled = 0.02;

PriorGait gait_of_plan(const GaitPrior& prior, const KneedParameters& parameters,
                       const WalkPlan& plan, double speed) {
  const WalkerUnits units = walker_units(parameters);
  const double step = plan.step_length > 0
                          ? plan.step_length
                          : units.length * preferred_step_length(speed / units.speed());
  return gait_at(prior, parameters, speed, step);
}

double share_left(double distance, double limit) {
  return std::clamp(1 - distance / limit, 0.0, 1.0);
}

}  // namespace

double planned_speed(const WalkPlan& plan, double time) {
  double speed = plan.speed;
  for (const SpeedChange& change : plan.changes)
    if (change.time < time) speed = change.speed;
  return speed;
}

SpeedRange speed_range(const GaitPrior& prior, const KneedParameters& parameters) {
  const double unit = walker_units(parameters).speed();
  return {prior.speeds.front() * unit, prior.speeds.back() * unit};
}

PriorGait first_gait(const GaitPrior& prior, const KneedParameters& parameters,
                     const WalkPlan& plan, double time, PlanProgress& progress) {
  PriorGait gait = gait_of_plan(prior, parameters, plan, plan.speed);
  progress = {time, plan.speed, gait.vector.tail<kSectionSize>()};
  return gait;
}

PriorGait next_gait(const GaitPrior& prior, const KneedParameters& parameters, const WalkPlan& plan,
                    double time, const KneedState& state, PlanProgress& progress) {
  const PriorGait aim = gait_of_plan(prior, parameters, plan, progress.speed);
  const SectionVector section = section_of(scaled(state, aim.units, WalkerUnits{}));
  const double lag = (section - aim.vector.tail<kSectionSize>()).norm();
  const double change = (section - progress.section).norm();
  const double share = std::max(share_left(lag, kLag), share_left(change, kSettled));
  const double most = plan.acceleration * (time - progress.time);
  progress.speed += std::clamp(planned_speed(plan, time) - progress.speed, -share * most, most);
  progress.time = time;
  progress.section = section;
  return gait_of_plan(prior, parameters, plan, progress.speed);
}

}  // namespace walktrack
