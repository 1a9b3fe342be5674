#include "walker/simulate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace walktrack {
inline namespace walker {
namespace {

using Eigen::VectorXd;

// A guard this near to zero counts as touching: after an event was located, other events of the
// same time are within rounding of it.
constexpr double kOnGuard = 1e-11;
// Number of pieces in which a step is searched for the crossing of a guard that starts at zero,
// rises and falls again. By hand.
constexpr int kScanPieces = 16;

std::optional<WalkerState> smooth_step(const Walker& walker, const WalkerState& state, double dt,
                                       const SimulationOptions& options) {
  if (dt == 0) return state;
  const Eigen::Index n = state.q.size();
  WalkerState stage = state;
  const Derivative derivative = [&](double, const VectorXd& y) {
    stage.q = y.head(n);
    stage.qd = y.tail(n);
    VectorXd rate(2 * n);
    rate << stage.qd, walker.acceleration(stage);
    return rate;
  };
  VectorXd y(2 * n);
  y << state.q, state.qd;
  const auto next = integrate_step(options.integrator, derivative, 0, dt, y);
  if (!next || next->tail(n).cwiseAbs().maxCoeff() > options.max_rate) return std::nullopt;
  WalkerState result = state;
  result.q = next->head(n);
  result.qd = next->tail(n);
  result.time += dt;
  return result;
}

std::optional<Guard> guard_of(const Walker& walker, const WalkerState& state, int id) {
  for (const Guard& guard : walker.guards(state)) {
    if (guard.id == id) return guard;
  }
  return std::nullopt;
}

// One guard along one smooth step of length `h` from `start`.
class Crossing {
 public:
  Crossing(const Walker& walker, const WalkerState& start, const SimulationOptions& options, int id)
      : walker_(walker), start_(start), options_(options), id_(id) {}

  double value(double t) const {
    const auto state = smooth_step(walker_, start_, t, options_);
    const auto guard = state ? guard_of(walker_, *state, id_) : std::nullopt;
    return guard ? guard->value : std::numeric_limits<double>::quiet_NaN();
  }

  // The time of a crossing of `level` between `low` (above it) and `high` (not above): regula falsi
  // with the Illinois modification, bisection if it stalls. Returns the end after the crossing.
  double locate(double low, double high, double level = 0) const {
    double f_low = value(low) - level, f_high = value(high) - level;
    for (int i = 0; i < 200 && high - low > options_.event_tolerance; ++i) {
      double middle = (f_low * high - f_high * low) / (f_low - f_high);
      if (i % 4 == 3 || !(middle > low && middle < high)) middle = (low + high) / 2;
      const double f = value(middle) - level;
      if (f > 0) {
        low = middle;
        f_low = f;
        f_high /= 2;
      } else {
        high = middle;
        f_high = f;
        f_low /= 2;
      }
    }
    return high;
  }

  // The time of the minimum in [0, h], by golden section.
  double lowest(double h) const {
    constexpr double kGolden = 0.6180339887498949;  // the golden ratio minus one
    double low = 0, high = h;
    for (int i = 0; i < 40 && high - low > options_.event_tolerance; ++i) {
      const double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
      if (value(left) < value(right)) {
        high = right;
      } else {
        low = left;
      }
    }
    return (low + high) / 2;
  }

  // For a guard that starts within kOnGuard of zero and ends below: the last piece of the step in
  // which it falls through zero; for a rebound shorter than a piece, its end. A guard that does not
  // rise above rounding fires when it is certainly below, so that time advances.
  double locate_after_rise(double h) const {
    for (int i = kScanPieces - 1; i > 0; --i) {
      const double t = h * i / kScanPieces;
      if (value(t) > 0) return locate(t, h);
    }
    const double shortest = options_.event_tolerance;
    for (double t = h / kScanPieces / 2; t > shortest; t /= 2) {
      if (value(t) > 0) return locate(t, 2 * t);
    }
    return locate(0, h, -kOnGuard / 2);  // still touching: it may fire again
  }

 private:
  const Walker& walker_;
  const WalkerState& start_;
  const SimulationOptions& options_;
  int id_;
};

// The time in [0, h] at which `before` fires, if it does; `after` is the guard at h.
std::optional<double> firing_time(const Crossing& crossing, const Guard& before, const Guard& after,
                                  double h) {
  if (before.value > kOnGuard) {
    if (after.value <= 0) return crossing.locate(0, h);
    const bool dips = before.rate && after.rate && *before.rate < 0 && *after.rate > 0;
    if (!dips) return std::nullopt;
    const double lowest = crossing.lowest(h);
    if (crossing.value(lowest) > 0) return std::nullopt;
    return crossing.locate(0, lowest);
  }
  if (before.value < -kOnGuard || !before.rate) {
    return std::nullopt;  // below from the start: not armed
  }
  if (*before.rate < 0) return 0.0;
  if (after.value < -kOnGuard) return crossing.locate_after_rise(h);
  return std::nullopt;
}

struct Firing {
  int id = -1;
  double time = std::numeric_limits<double>::infinity();
};

// The first guard to fire within one smooth step of length h from `state`.
Firing first_firing(const Walker& walker, const WalkerState& state,
                    const std::vector<Guard>& before, const std::vector<Guard>& after, double h,
                    const SimulationOptions& options, const std::vector<int>& refused) {
  Firing first;
  for (const Guard& guard : before) {
    const auto same = std::find_if(after.begin(), after.end(),
                                   [&](const Guard& other) { return other.id == guard.id; });
    if (same == after.end()) continue;
    if (std::find(refused.begin(), refused.end(), guard.id) != refused.end()) continue;
    const Crossing crossing(walker, state, options, guard.id);
    const auto time = firing_time(crossing, guard, *same, h);
    if (time && *time < first.time) first = {guard.id, *time};
  }
  return first;
}

bool is_finite(const WalkerState& state) { return state.q.allFinite() && state.qd.allFinite(); }

// A simulation of a walker.
class Run {
 public:
  Run(const Walker& walker, WalkerState& state, const SimulationOptions& options,
      std::vector<WalkerEvent>& events, const StateObserver& observe)
      : walker_(walker),
        state_(state),
        options_(options),
        events_(events),
        observe_(observe),
        guards_(walker.guards(state)) {}

  // One smooth step towards the time `end`, or the part of it before an event, which is handled.
  // Returns true if the event completed a step of the walker.
  bool step(double end) {
    const double left = end - state_.time;
    const double h = std::min(options_.max_step, left);
    const auto next = smooth_step(walker_, state_, h, options_);
    if (!next) return fail();
    const std::vector<Guard> after = walker_.guards(*next);
    const Firing firing = first_firing(walker_, state_, guards_, after, h, options_, refused_);
    if (firing.id >= 0) return meet(firing);
    state_ = *next;
    if (h == left) state_.time = end;
    guards_ = after;
    refused_.clear();
    report();
    return false;
  }

 private:
  bool fail() {
    state_.health = Health::kDiverged;
    return false;
  }

  void report() const {
    if (observe_) observe_(state_);
  }

  bool meet(const Firing& firing) {
    const auto at_event = smooth_step(walker_, state_, firing.time, options_);
    if (!at_event || ++count_ > options_.max_events) return fail();
    if (firing.time > 0) refused_.clear();
    state_ = *at_event;
    auto transition = walker_.event(firing.id, state_);
    if (!transition) {
      refused_.push_back(firing.id);
      guards_ = walker_.guards(state_);
      return false;
    }
    report();
    if (!is_finite(transition->after)) return fail();
    state_ = transition->after;
    report();
    guards_ = walker_.guards(state_);
    const bool complete = transition->completes_step;
    events_.push_back({state_.time, std::move(*transition)});
    return complete;
  }

  const Walker& walker_;
  WalkerState& state_;
  const SimulationOptions& options_;
  std::vector<WalkerEvent>& events_;
  const StateObserver& observe_;
  std::vector<Guard> guards_;
  std::vector<int> refused_;  // guards without effect at this time
  int count_ = 0;
};

}  // namespace

bool advance(const Walker& walker, WalkerState& state, double duration,
             const SimulationOptions& options, std::vector<WalkerEvent>& events,
             const StateObserver& observe) {
  const double end = state.time + duration;
  Run run(walker, state, options, events, observe);
  while (state.health == Health::kSound && state.time < end) {
    if (run.step(end)) return state.health == Health::kSound;
  }
  return false;
}

std::optional<WalkerStep> take_step(const Walker& walker, const WalkerState& start,
                                    const SimulationOptions& options, double max_time) {
  WalkerStep step;
  step.end = walker.settled(start);
  step.lowest_normal = std::numeric_limits<double>::infinity();
  const double begin = start.time;
  double last_time = begin;
  VectorXd last_powers = walker.actuator_powers(step.end);
  const auto observe = [&](const WalkerState& now) {
    const VectorXd powers = walker.actuator_powers(now);
    const double dt = now.time - last_time;
    step.positive_work += dt / 2 * (powers.cwiseMax(0).sum() + last_powers.cwiseMax(0).sum());
    last_powers = powers;
    last_time = now.time;
    for (const ContactForce& contact : walker.contact_forces(now)) {
      step.lowest_normal = std::min(step.lowest_normal, contact.force.y());
    }
  };
  if (!advance(walker, step.end, max_time, options, step.events, observe)) return std::nullopt;
  for (const WalkerEvent& event : step.events) step.positive_work += event.transition.actuator_work;
  step.period = step.end.time - begin;
  step.travel = step.events.back().transition.advance;
  step.step_length = step.events.back().transition.feet_apart;
  return step;
}

}  // namespace walker
}  // namespace walktrack
