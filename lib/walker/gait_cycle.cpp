#include "walker/gait_cycle.h"

namespace walktrack {
inline namespace walker {
namespace {

using Eigen::VectorXd;

WalkerState state_of(const Walker& walker, const VectorXd& x) {
  const Eigen::Index n = x.size() / 2;
  return walker.section_state(x.head(n), x.tail(n));
}

}  // namespace

ReturnMap step_map(const Walker& walker, const GaitOptions& options) {
  return [&walker, options](const VectorXd& x) -> std::optional<VectorXd> {
    const auto step = take_step(walker, state_of(walker, x), options.simulation, options.max_time);
    if (!step) return std::nullopt;
    return walker.section_point(step->end);
  };
}

SectionRows section_rows(const Walker& walker) {
  return [&walker](const VectorXd& x) { return walker.section_rows(state_of(walker, x)); };
}

std::optional<GaitCycle> describe_cycle(const Walker& walker, const LimitCycle& cycle,
                                        const GaitOptions& options) {
  GaitCycle gait;
  gait.cycle = cycle;
  gait.start = state_of(walker, cycle.point);
  const auto step = take_step(walker, gait.start, options.simulation, options.max_time);
  if (!step) return std::nullopt;
  gait.step = *step;
  gait.speed = step->travel / step->period;
  gait.cost_of_transport = step->positive_work / (walker.weight() * step->travel);
  return gait;
}

}  // namespace walker
}  // namespace walktrack
