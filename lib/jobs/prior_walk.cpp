#include "jobs/prior_walk.h"

#include <fmt/format.h>

#include "core/errors.h"
#include "walker/linkage_walker.h"

namespace walktrack {
namespace {

// The table ends where walking does; what it does not hold it would replace by its border.
void check_speeds(const GaitPrior& prior, const KneedParameters& parameters, const WalkPlan& plan) {
  constexpr double kRounding = 1.01;  // 2.2 m/s is in a table that ends at 2.199
  const auto [least, most] = speed_range(prior, parameters);
  const auto check = [least = least, most = most](double speed) {
    if (speed * kRounding >= least && speed <= most * kRounding) return;
    throw UsageError(
        describe({"", 0, "speed"}, fmt::format("{:g} m/s", speed),
                 fmt::format("{:.2f} to {:.2f} m/s, which the table of gaits holds for this body",
                             least, most)));
  };
  check(plan.speed);
  for (const SpeedChange& change : plan.changes) check(change.speed);
}

}  // namespace

SimulateJob with_prior(SimulateJob job, const WalkPlan& plan) {
  const KneedParameters parameters = job.model.kneed;
  if (job.model.model != "kneed" || parameters.torso.inertia <= 0) {
    throw UsageError(
        describe({"", 0, "--prior"}, "a model of another kind", "the kneed walker with a torso"));
  }
  const GaitPrior prior = load_gait_prior();
  check_speeds(prior, parameters, plan);
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

}  // namespace walktrack
