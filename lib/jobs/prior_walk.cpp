#include "jobs/prior_walk.h"

#include "core/errors.h"
#include "walker/linkage_walker.h"

namespace walktrack {

SimulateJob with_prior(SimulateJob job, const WalkPlan& plan) {
  const KneedParameters parameters = job.model.kneed;
  if (job.model.model != "kneed" || parameters.torso.inertia <= 0) {
    throw UsageError(
        describe({"", 0, "--prior"}, "a model of another kind", "the kneed walker with a torso"));
  }
  const GaitPrior prior = load_gait_prior();
  const PriorGait first = planned_gait(prior, parameters, plan, 0);
  job.model.controls = first.controls;
  job.model.style = {.latched = false, .may_fly = false};
  job.model.start.q.assign(first.start.q.begin(), first.start.q.end());
  job.model.start.qd.assign(first.start.qd.begin(), first.start.qd.end());
  job.next_walker = [prior, parameters, plan, style = job.model.style](const WalkerState& state) {
    const PriorGait gait = planned_gait(prior, parameters, plan, state.time);
    KneedState section;
    section.q = state.q;
    section.qd = state.qd;
    const KneedControls controls = next_controls(gait, section, plan.feedback);
    return std::make_unique<LinkageWalker>(kneed(parameters, controls, style));
  };
  return job;
}

}  // namespace walktrack
