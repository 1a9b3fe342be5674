#include "jobs/prior/prior_walk.h"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/errors.h"
#include "walker/linkage/linkage_walker.h"

namespace walktrack {
inline namespace jobs {
namespace {

// The speeds that occur in a plan.
std::vector<double> speeds_of(const WalkPlan& plan) {
  std::vector<double> speeds{plan.speed};
  for (const SpeedChange& change : plan.changes) speeds.push_back(change.speed);
  return speeds;
}

// Refuses speeds outside the table, which would otherwise be replaced by its limits.
void check_speeds(const PriorAxes& axes, const WalkerUnits& units, const WalkPlan& plan) {
  constexpr double kRounding = 1.01;  // 2.2 m/s is in a table that ends at 2.199
  const SpeedRange range = speed_range(axes, units);
  for (const double speed : speeds_of(plan)) {
    if (speed * kRounding >= range.least && speed <= range.most * kRounding) continue;
    throw UsageError(
        describe({"", 0, "speed"}, fmt::format("{:g} m/s", speed),
                 fmt::format("{:.2f} to {:.2f} m/s, which the table of gaits holds for this body "
                             "(legs of {:.3g} m, gravity of {:.3g} m/s^2)",
                             range.least, range.most, units.length, units.gravity)));
  }
}

void check_slope(const PriorAxes& axes, double slope) {
  constexpr double kRounding = 1e-9;
  if (slope >= axes.slopes.front() - kRounding && slope <= axes.slopes.back() + kRounding) return;
  throw UsageError(describe({"", 0, "--prior"}, fmt::format("{:.4g} rad of slope", slope),
                            fmt::format("{:g} to {:g}, downhill, which the table of gaits holds",
                                        axes.slopes.front(), axes.slopes.back())));
}

// Refuses a plan whose step length is not in the table, for which a gait nearby would be taken.
template <typename Prior, typename Parameters>
void check_step_length(const Prior& prior, const Parameters& parameters, const WalkPlan& plan) {
  constexpr double kRounding = 1.01;
  if (plan.step_length == 0) return;
  for (const double speed : speeds_of(plan)) {
    const double nearest = gait_at(prior, parameters, speed, plan.step_length).step_length;
    if (plan.step_length * kRounding >= nearest && plan.step_length <= nearest * kRounding)
      continue;
    throw UsageError(describe(
        {"", 0, "--step-length"}, fmt::format("{:g} m at {:g} m/s", plan.step_length, speed),
        fmt::format("{:.3f} m, the nearest that the table of gaits holds at this speed, or 0 for "
                    "what people prefer",
                    nearest)));
  }
}

SimulateJob kneed_with_prior(SimulateJob job, const WalkPlan& plan) {
  const KneedParameters parameters = job.model.kneed;
  const GaitPrior prior = load_gait_prior();
  check_speeds(prior, walker_units(parameters), plan);
  check_slope(prior, parameters.slope);
  check_step_length(prior, parameters, plan);
  PlanProgress progress;
  const PriorGait first = first_gait(prior, parameters, plan, 0, progress);
  job.model.controls = first.controls;
  job.model.style = {.latched = false, .may_fly = false};
  job.model.start.q.assign(first.start.q.begin(), first.start.q.end());
  job.model.start.qd.assign(first.start.qd.begin(), first.start.qd.end());
  job.next_walker = [prior, parameters, plan, progress,
                     style = job.model.style](const WalkerState& state) mutable {
    KneedState section;
    section.q = state.q;
    section.qd = state.qd;
    const PriorGait gait = next_gait(prior, parameters, plan, state.time, section, progress);
    const KneedControls controls = next_controls(gait, section, plan.feedback);
    return std::make_unique<LinkageWalker>(kneed(parameters, controls, style));
  };
  return job;
}

StraightLeggedParameters controlled(StraightLeggedParameters parameters,
                                    const StraightControls& controls) {
  parameters.hip_stiffness = controls.stiffness;
  parameters.toe_off_impulse = controls.toe_off_impulse;
  return parameters;
}

// With two controls this walker can neither brake nor climb, so that the table has no gaits there.
void check_gaits(const StraightPrior& prior, const StraightLeggedParameters& parameters,
                 const WalkPlan& plan) {
  for (const double speed : speeds_of(plan)) {
    WalkPlan steady = plan;
    steady.speed = speed;
    PlanProgress progress;
    if (first_gait(prior, parameters, steady, 0, progress).valid) continue;
    throw UsageError(describe({"", 0, "--prior"}, fmt::format("{:.4g} m/s", speed),
                              "a faster walk: so slow a one would have to brake"));
  }
}

SimulateJob straight_with_prior(SimulateJob job, const WalkPlan& plan) {
  StraightLeggedParameters& parameters = job.model.anthropomorphic;
  const StraightPrior prior = load_straight_prior();
  check_speeds(prior, walker_units(parameters), plan);
  check_slope(prior, parameters.slope);
  check_gaits(prior, parameters, plan);
  check_step_length(prior, parameters, plan);
  PlanProgress progress;
  const StraightGait first = first_gait(prior, parameters, plan, 0, progress);
  parameters = controlled(parameters, first.controls);
  job.model.start.q.assign(first.start.q.begin(), first.start.q.end());
  job.model.start.qd.assign(first.start.qd.begin(), first.start.qd.end());
  job.next_walker = [prior, parameters, plan, progress](const WalkerState& state) mutable {
    StraightState section;
    section.q = state.q;
    section.qd = state.qd;
    const StraightGait gait = next_gait(prior, parameters, plan, state.time, section, progress);
    const StraightControls controls = next_controls(gait, section, plan.feedback);
    return std::make_unique<LinkageWalker>(straight_legged(controlled(parameters, controls)));
  };
  return job;
}

}  // namespace

SimulateJob with_prior(SimulateJob job, const WalkPlan& plan) {
  if (job.model.model == "anthropomorphic" && !job.model.anthropomorphic.may_fly)
    return straight_with_prior(std::move(job), plan);
  if (job.model.model == "kneed" && job.model.kneed.torso.inertia > 0)
    return kneed_with_prior(std::move(job), plan);
  throw UsageError(
      describe({"", 0, "--prior"}, "a model of another kind",
               "the kneed walker with a torso, the anthropomorphic walker that does not fly"));
}

}  // namespace jobs
}  // namespace walktrack
