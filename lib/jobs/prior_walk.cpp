#include "jobs/prior_walk.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "gait/gait_prior.h"
#include "walker/linkage_walker.h"

namespace walktrack {
namespace {

PriorGait gait_at_time(const GaitPrior& prior, const KneedParameters& parameters,
                       const PriorWalk& walk, double time) {
  const double speed = wanted_speed(walk, time);
  const WalkerUnits units = walker_units(parameters);
  const double step = walk.step_length > 0
                          ? walk.step_length
                          : units.length * preferred_step_length(speed / units.speed());
  return gait_at(prior, parameters, speed, step);
}

}  // namespace

double wanted_speed(const PriorWalk& walk, double time) {
  double speed = walk.speed;
  for (size_t i = 0; i < walk.changes.size() && walk.changes[i].time < time; ++i) {
    const double until =
        i + 1 < walk.changes.size() ? std::min(time, walk.changes[i + 1].time) : time;
    const double most = walk.acceleration * (until - walk.changes[i].time);
    speed += std::clamp(walk.changes[i].speed - speed, -most, most);
  }
  return speed;
}

SimulateJob with_prior(SimulateJob job, const PriorWalk& walk) {
  const KneedParameters parameters = job.model.kneed;
  if (job.model.model != "kneed" || parameters.torso.inertia <= 0) {
    throw UsageError(
        describe({"", 0, "--prior"}, "a model of another kind", "the kneed walker with a torso"));
  }
  const GaitPrior prior = load_gait_prior();
  const PriorGait first = gait_at_time(prior, parameters, walk, 0);
  job.model.controls = first.controls;
  job.model.style = {.latched = false, .may_fly = false};
  job.model.start.q.assign(first.start.q.begin(), first.start.q.end());
  job.model.start.qd.assign(first.start.qd.begin(), first.start.qd.end());
  job.next_walker = [prior, parameters, walk, style = job.model.style](const WalkerState& state) {
    const PriorGait gait = gait_at_time(prior, parameters, walk, state.time);
    KneedState section;
    section.q = state.q;
    section.qd = state.qd;
    const KneedControls controls = next_controls(gait, section, walk.feedback);
    return std::make_unique<LinkageWalker>(kneed(parameters, controls, style));
  };
  return job;
}

}  // namespace walktrack
