// Like kneed_batch.cpp with one kind of event: a strike, which ends the call.
#include "walker/straight/straight_batch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "walker/kneed/kneed_incidents.h"
#include "walker/lanes/lane_batch.h"
#include "walker/straight/straight_lanes.h"

namespace walktrack {
inline namespace walker {
namespace {

// Uncertainty of an event's location, rad, which the lead of a foot has to exceed: see
// LinkageWalker.
constexpr double kAheadAngle = 1e-9;

struct StraightInput {
  const StraightModel& model;
  std::span<const StraightControls> controls;
  std::span<const Vector2> noise;
  std::span<const double> durations;
  std::span<StraightState> states;
  std::span<StraightAdvance> results;
  double max_step;
};

// Positive before a strike.
double strike_guard(const StraightLanePoint& at, size_t lane) {
  return -(at.q[0][lane] + at.q[1][lane]);
}

class StraightStepper : public LaneBatch<StraightStepper, StraightInput, StraightLanes> {
 public:
  using LaneBatch::LaneBatch;

  void load(size_t i, size_t lane, StraightLanes& lanes) const {
    lanes.since[0][lane] = in.states[i].since_transfer;
    lanes.stiffness[0][lane] = in.controls[i].stiffness;
    for (size_t k = 0; k < 2; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      lanes.at.q[k][lane] = in.states[i].q[row];
      lanes.at.qd[k][lane] = in.states[i].qd[row];
      lanes.noise[k][lane] = in.noise[i][row];
    }
  }
  void store(const StraightLanes& lanes, size_t lane) const {
    StraightState& state = in.states[lanes.index[lane]];
    state.q = {lanes.at.q[0][lane], lanes.at.q[1][lane]};
    state.qd = {lanes.at.qd[0][lane], lanes.at.qd[1][lane]};
    state.since_transfer = lanes.since[0][lane];
  }
  void evaluate(StraightLanes& lanes) const { evaluate_lanes(in.model, lanes); }
  LaneVerdict sub_step(StraightLanes& lanes) const { return sub_step_lanes(in.model, lanes); }

  // For the first visit in a call: chooses sub-steps and removes invalid states.
  void begin(StraightLanes& lanes) {
    LaneRows<1> steps;
    lane_step_sizes(in.model, lanes, in.max_step, steps[0]);
    for (size_t lane = 0; lane < lanes.count; ++lane) {
      LaneProgress& p = progress[lanes.index[lane]];
      if (p.step != 0) continue;
      p.step = lanes.step[0][lane] = steps[0][lane];
      if (!is_sound(lanes, lane) || !(p.step >= kMinStep))
        finish(lanes, lane, KneedEvent::kDiverged);
    }
  }

  bool has_fallen(const StraightLanes& lanes, size_t lane) const {
    return in.model.radius + in.model.leg * std::cos(lanes.at.q[0][lane]) < in.model.least_hip;
  }

  void resolve(StraightLanes& lanes);

 private:
  static bool is_sound(const StraightLanes& lanes, size_t lane) {
    double sum = 0, fastest = 0;
    for (size_t k = 0; k < 2; ++k) {
      const double rate = std::abs(lanes.at.qd[k][lane]);
      sum += std::abs(lanes.at.q[k][lane]) + rate + std::abs(lanes.at.qdd[k][lane]);
      fastest = std::max(fastest, rate);
    }
    return std::isfinite(sum) && fastest < kMaxRate;
  }

  std::array<bool, kMaxLanes> locate(const StraightLanes& lanes, double* h) const;
  void arrive(StraightLanes& lanes, size_t lane, bool strikes);
};

// Shortens the sub-steps h to the strikes within them; evaluations for all lanes share vectors.
// Legs that cross the ground while they pass each other do not strike: they keep their sub-step.
std::array<bool, kMaxLanes> StraightStepper::locate(const StraightLanes& lanes, double* h) const {
  StraightLanePoint at;
  step_lanes_to(in.model, lanes, h, at);
  std::array<FallSearch, kMaxLanes> searches;
  for (size_t lane = 0; lane < lanes.count; ++lane)
    searches[lane] = {0, strike_guard(lanes.at, lane), h[lane], strike_guard(at, lane)};
  const auto searching = [](const FallSearch& search) { return !search.done(); };
  LaneRows<1> trials{};
  while (std::any_of(searches.begin(), searches.end(), searching)) {
    for (size_t lane = 0; lane < lanes.count; ++lane)
      trials[0][lane] = searches[lane].done() ? 0 : searches[lane].trial();
    step_lanes_to(in.model, lanes, trials[0], at);
    for (size_t lane = 0; lane < lanes.count; ++lane)
      if (!searches[lane].done()) searches[lane].take(strike_guard(at, lane));
  }
  for (size_t lane = 0; lane < lanes.count; ++lane) trials[0][lane] = searches[lane].root();
  step_lanes_to(in.model, lanes, trials[0], at);
  std::array<bool, kMaxLanes> strikes{};
  for (size_t lane = 0; lane < lanes.count; ++lane) {
    strikes[lane] = at.q[0][lane] - at.q[1][lane] > kAheadAngle;
    if (strikes[lane]) h[lane] = trials[0][lane];
  }
  return strikes;
}

void StraightStepper::resolve(StraightLanes& lanes) {
  LaneRows<1> h{};
  next_lane_steps(lanes, h[0]);
  const std::array<bool, kMaxLanes> strikes = locate(lanes, h[0]);
  StraightLanePoint end;
  step_lanes_to(in.model, lanes, h[0], end);
  lanes.at = end;
  for (size_t lane = 0; lane < lanes.count; ++lane) {
    pass(lanes, lane, h[0][lane]);
    arrive(lanes, lane, strikes[lane]);
  }
}

void StraightStepper::arrive(StraightLanes& lanes, size_t lane, bool strikes) {
  const size_t i = lanes.index[lane];
  if (has_fallen(lanes, lane)) return finish(lanes, lane, KneedEvent::kFallen);
  finish(lanes, lane, KneedEvent::kNone);
  if (!strikes) {
    if (progress[i].elapsed < in.durations[i]) queues.ready.push_back(i);
    return;
  }
  const StraightTransfer transfer =
      straight_support_transfer(in.model, in.controls[i].toe_off_impulse, in.states[i]);
  in.states[i] = transfer.state;
  in.results[i] = {.elapsed = lanes.elapsed[0][lane],
                   .event = KneedEvent::kTransfer,
                   .impulse = transfer.impulse,
                   .step_length = transfer.step_length,
                   .toe_off_work = transfer.toe_off_work,
                   .old_foot_lifts = transfer.old_foot_lifts};
}

}  // namespace

void straight_advance_batch(const StraightModel& model, std::span<const StraightControls> controls,
                            std::span<const Vector2> noise, std::span<const double> durations,
                            std::span<StraightState> states, std::span<StraightAdvance> results,
                            double max_step) {
  StraightStepper({model, controls, noise, durations, states, results, max_step}).run();
}

StraightAdvance straight_advance(const StraightModel& model, const StraightControls& controls,
                                 const Vector2& noise, StraightState& state, double duration,
                                 double max_step) {
  StraightAdvance result;
  straight_advance_batch(model, {&controls, 1}, {&noise, 1}, {&duration, 1}, {&state, 1},
                         {&result, 1}, max_step);
  return result;
}

}  // namespace walker
}  // namespace walktrack
