#include "walker/kneed/kneed_batch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "walker/kneed/kneed_incidents.h"
#include "walker/kneed/kneed_lane_walkers.h"
#include "walker/kneed/kneed_stops.h"
#include "walker/lanes/lane_batch.h"

namespace walktrack {
inline namespace walker {
namespace {

struct BatchInput {
  const KneedModel& model;
  std::span<const KneedControls> controls;
  std::span<const Vector5> noise;
  std::span<const double> durations;
  std::span<KneedState> states;
  std::span<KneedAdvance> results;
  const KneedLimits& limits;
};

class Stepper : public LaneBatch<Stepper, BatchInput, Lanes> {
 public:
  explicit Stepper(const BatchInput& input)
      : LaneBatch(input),
        model(lane_model(input.model)),
        bounds{input.limits.min_hip_height * standing_hip_height(input.model.parameters),
               input.limits.max_torso_lean} {}

  void load(size_t i, size_t lane, Lanes& lanes) const {
    load_state(in.states[i], lane, lanes);
    load_forces(in.controls[i], in.noise[i], lane, lanes);
  }
  void store(const Lanes& lanes, size_t lane) const {
    store_state(lanes, lane, in.states[lanes.index[lane]]);
  }
  void evaluate(Lanes& lanes) const { evaluate_lanes(model, lanes); }
  LaneVerdict sub_step(Lanes& lanes) const { return sub_step_lanes(model, bounds, lanes); }

  // For the first visit in a call: makes stops consistent, chooses sub-steps, and removes invalid
  // states.
  void begin(Lanes& lanes) {
    bool changed = false;
    for (size_t lane = 0; lane < lanes.count; ++lane) {
      const size_t i = lanes.index[lane];
      if (progress[i].step != 0 || is_settled(lanes, lane)) continue;
      settle(i);
      load_state(in.states[i], lane, lanes);
      changed = true;
    }
    if (changed) evaluate_lanes(model, lanes);
    LaneRows<1> steps;
    lane_step_sizes(model, lanes, in.limits.max_step, steps[0]);
    for (size_t lane = 0; lane < lanes.count; ++lane) {
      LaneProgress& p = progress[lanes.index[lane]];
      if (p.step != 0) continue;
      p.step = lanes.step[0][lane] = steps[0][lane];
      const bool sound = is_sound(lanes.at, lane) && p.step >= kMinStep;
      if (!sound) finish(lanes, lane, KneedEvent::kDiverged);
    }
  }

  bool has_fallen(const Lanes& lanes, size_t lane) const {
    return lanes.at.hip[0][lane] < bounds.least_hip ||
           std::abs(lanes.at.q[0][lane]) > bounds.max_lean;
  }

  void resolve(Lanes& lanes);

 private:
  void settle(size_t i) { settle_knee_stops(in.model, in.controls[i], in.noise[i], in.states[i]); }
  void locate(const Lanes& lanes, const LanePoint& end, const double* h,
              std::array<LaneIncident, kMaxLanes>& incidents) const;
  void apply(const LaneIncident& incident, Lanes& lanes, size_t lane);

  const LaneModel model;
  const LaneBounds bounds;
};

// Finds the first event of every lane; evaluations for all lanes' searches share vectors.
void Stepper::locate(const Lanes& lanes, const LanePoint& end, const double* h,
                     std::array<LaneIncident, kMaxLanes>& incidents) const {
  for (size_t lane = 0; lane < lanes.count; ++lane)
    incidents[lane] = LaneIncident(lanes, end, lane, h[lane]);
  LanePoint at;
  LaneRows<1> trials;
  const auto searching = [](const LaneIncident& incident) { return incident.searching(); };
  while (std::any_of(incidents.begin(), incidents.end(), searching)) {
    for (size_t lane = 0; lane < lane_limit; ++lane) trials[0][lane] = incidents[lane].trial();
    step_lanes_to(model, lanes, trials[0], at);
    for (LaneIncident& incident : incidents)
      if (incident.searching()) incident.take(lanes, at, end);
  }
}

void Stepper::resolve(Lanes& lanes) {
  LaneRows<1> h;
  next_lane_steps(lanes, h[0]);
  LanePoint end;
  step_lanes_to(model, lanes, h[0], end);
  std::array<LaneIncident, kMaxLanes> incidents;
  locate(lanes, end, h[0], incidents);
  for (size_t lane = 0; lane < lanes.count; ++lane)
    if (incidents[lane].found()) h[0][lane] = incidents[lane].first().time;
  const LanePoint from = lanes.at;
  step_lanes_to(model, lanes, h[0], end);
  lanes.at = end;
  for (size_t lane = 0; lane < lanes.count; ++lane) {
    const double fall = from.height_rate[0][lane], rise = end.height_rate[0][lane];
    const double step = h[0][lane];
    if (fall < 0 && rise > 0)
      lanes.clearance[0][lane] =
          std::min(lanes.clearance[0][lane],
                   from.height[0][lane] - 0.5 * fall * fall * step / (rise - fall));
    pass(lanes, lane, step);
    apply(incidents[lane], lanes, lane);
  }
}

// Applies an event to the walker that has reached it.
void Stepper::apply(const LaneIncident& incident, Lanes& lanes, size_t lane) {
  const size_t i = lanes.index[lane];
  const auto is = [&](IncidentKind kind) {
    return incident.found() && incident.first().kind == kind;
  };
  if (is(IncidentKind::kStumble) || has_fallen(lanes, lane))
    return finish(lanes, lane, KneedEvent::kFallen);
  finish(lanes, lane, KneedEvent::kNone);
  if (is(IncidentKind::kStrike))
    return transfer_support(in.model, in.controls[i], in.noise[i], in.states[i], in.results[i]);
  if (incident.found()) {
    settle(i);
    if (++progress[i].stop_events > kMaxStopEvents) {
      in.results[i].event = KneedEvent::kDiverged;
      return;
    }
  }
  if (progress[i].elapsed < in.durations[i]) queues.ready.push_back(i);
}

}  // namespace

void kneed_advance_batch(const KneedModel& model, std::span<const KneedControls> controls,
                         std::span<const Vector5> noise, std::span<const double> durations,
                         std::span<KneedState> states, std::span<KneedAdvance> results,
                         const KneedLimits& limits) {
  Stepper({model, controls, noise, durations, states, results, limits}).run();
}

}  // namespace walker
}  // namespace walktrack
