#include "gait/walk_plan.h"

#include <algorithm>

namespace walktrack {
inline namespace gait {
namespace {

// Distances of sections, in units L = M = g = 1, up to which a walker may be slowed down: from the
// intended gait, and between two transfers. The table's gaits are 0.05 to 0.25 apart for 0.1 m/s.
// On slopes between its nodes a walker settles up to 0.4 from the interpolated gait, so that the
// first limit alone would hold it for ever. Of 84 changes between seven speeds on level ground and
// 6 % uphill none leads to a fall, of 42 downhill two to 0.5 m/s do.
constexpr double kLag = 0.15;
constexpr double kSettled = 0.02;

template <typename Prior, typename Parameters>
auto gait_of_plan(const Prior& prior, const Parameters& parameters, const WalkPlan& plan,
                  double speed) {
  const WalkerUnits units = walker_units(parameters);
  const double step = plan.step_length > 0
                          ? plan.step_length
                          : units.length * preferred_step_length(speed / units.speed());
  return gait_at(prior, parameters, speed, step);
}

SectionVector section_of(const PriorGait& gait, const KneedState& state) {
  return walktrack::section_of(scaled(state, gait.units, WalkerUnits{}));
}
SectionVector own_section(const PriorGait& gait) { return gait.vector.tail<kSectionSize>(); }
StraightSection own_section(const StraightGait& gait) {
  return gait.vector.tail<kStraightSectionSize>();
}

double share_left(double distance, double limit) {
  return std::clamp(1 - distance / limit, 0.0, 1.0);
}

template <typename Prior, typename Parameters>
auto first_of_plan(const Prior& prior, const Parameters& parameters, const WalkPlan& plan,
                   double time, PlanProgress& progress) {
  auto gait = gait_of_plan(prior, parameters, plan, plan.speed);
  progress = {time, plan.speed, own_section(gait)};
  return gait;
}

template <typename Prior, typename Parameters, typename State>
auto next_of_plan(const Prior& prior, const Parameters& parameters, const WalkPlan& plan,
                  double time, const State& state, PlanProgress& progress) {
  const auto aim = gait_of_plan(prior, parameters, plan, progress.speed);
  const auto section = section_of(aim, state);
  const double lag = (section - own_section(aim)).norm();
  const double change = (section - progress.section).norm();
  const double share = std::max(share_left(lag, kLag), share_left(change, kSettled));
  const double most = plan.acceleration * (time - progress.time);
  progress.speed += std::clamp(planned_speed(plan, time) - progress.speed, -share * most, most);
  progress.time = time;
  progress.section = section;
  return gait_of_plan(prior, parameters, plan, progress.speed);
}

}  // namespace

double planned_speed(const WalkPlan& plan, double time) {
  double speed = plan.speed;
  for (const SpeedChange& change : plan.changes)
    if (change.time < time) speed = change.speed;
  return speed;
}

SpeedRange speed_range(const PriorAxes& axes, const WalkerUnits& units) {
  return {axes.speeds.front() * units.speed(), axes.speeds.back() * units.speed()};
}

PriorGait first_gait(const GaitPrior& prior, const KneedParameters& parameters,
                     const WalkPlan& plan, double time, PlanProgress& progress) {
  return first_of_plan(prior, parameters, plan, time, progress);
}

PriorGait next_gait(const GaitPrior& prior, const KneedParameters& parameters, const WalkPlan& plan,
                    double time, const KneedState& state, PlanProgress& progress) {
  return next_of_plan(prior, parameters, plan, time, state, progress);
}

StraightGait first_gait(const StraightPrior& prior, const StraightLeggedParameters& parameters,
                        const WalkPlan& plan, double time, PlanProgress& progress) {
  return first_of_plan(prior, parameters, plan, time, progress);
}

StraightGait next_gait(const StraightPrior& prior, const StraightLeggedParameters& parameters,
                       const WalkPlan& plan, double time, const StraightState& state,
                       PlanProgress& progress) {
  return next_of_plan(prior, parameters, plan, time, state, progress);
}

}  // namespace gait
}  // namespace walktrack
