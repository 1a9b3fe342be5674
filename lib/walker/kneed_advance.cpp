#include "walker/kneed_advance.h"

#include <algorithm>
#include <cmath>

namespace walktrack {
namespace {

constexpr double kMinStep = 1e-7;          // s; a walker that needs less is reported as diverged
constexpr double kMaxRate = 1e3;           // rad/s; ten times what a sprinter's shank reaches
constexpr int kMaxStopEvents = 64;         // in one call; a step has about four
constexpr double kHastyTransfer = 0.02;    // s; a step takes ten times that
constexpr int kMaxHastyTransfers = 8;      // in a row
constexpr double kTimeTolerance = 1e-13;   // s, of a located event
constexpr double kGuardTolerance = 1e-13;  // rad, m or N m: rounding of a guard

// A point of the trajectory with the acceleration and the swing foot there.
struct Node {
  KneedState state;
  KneedAcceleration acceleration;
  SwingFoot foot;
};

struct Motion {
  const KneedModel& model;
  const KneedControls& controls;
  const Vector5& noise;

  KneedAcceleration at(const KneedState& state) const {
    return kneed_accelerations(model, controls, noise, state);
  }

  Node node(const KneedState& state) const {
    return {state, at(state), kneed_swing_foot(model, state)};
  }

  // One RK4 step with the stops held as they are.
  Node step(const Node& from, double h) const {
    const KneedState& s = from.state;
    const Vector5& a1 = from.acceleration.qdd;
    KneedState stage = s;
    stage.q = s.q + 0.5 * h * s.qd;
    stage.qd = s.qd + 0.5 * h * a1;
    const Vector5 v2 = stage.qd, a2 = at(stage).qdd;
    stage.q = s.q + 0.5 * h * v2;
    stage.qd = s.qd + 0.5 * h * a2;
    const Vector5 v3 = stage.qd, a3 = at(stage).qdd;
    stage.q = s.q + h * v3;
    stage.qd = s.qd + h * a3;
    const Vector5 v4 = stage.qd, a4 = at(stage).qdd;
    stage.q = s.q + h / 6 * (s.qd + 2 * (v2 + v3) + v4);
    stage.qd = s.qd + h / 6 * (a1 + 2 * (a2 + a3) + a4);
    stage.since_transfer += h;
    return node(stage);
  }
};

// Positive while all is well (a held stop's torque included); an event is the fall through zero.
enum class Guard { kStanceKnee, kSwingKnee, kFootHeight, kFootBehind };

double guard_value(Guard guard, const Node& node) {
  const KneedState& s = node.state;
  switch (guard) {
    case Guard::kStanceKnee:
      return s.stance_stop ? node.acceleration.stop_torque[0]
                           : s.q[kStanceShank] - s.q[kStanceThigh];
    case Guard::kSwingKnee:
      return s.swing_stop ? node.acceleration.stop_torque[1] : s.q[kSwingShank] - s.q[kSwingThigh];
    case Guard::kFootHeight:
      return node.foot.height;
    case Guard::kFootBehind:
      return -node.foot.lead;
  }
  return 0;
}

// Time in (begin, end] at which the guard, positive before and not positive at `end`, reaches zero:
// the Illinois variant of regula falsi (a bracket's end that stays twice loses half its weight),
// and bisection while the guard still leaves zero itself.
double locate(const Motion& motion, Guard guard, const Node& from, double begin, double end) {
  const auto value = [&](double t) {
    return guard_value(guard, t == 0 ? from : motion.step(from, t));
  };
  double low = begin, high = end, at_low = value(low), at_high = value(high);
  int low_stays = 0, high_stays = 0;
  constexpr int kMaxTrials = 60;
  for (int i = 0; i < kMaxTrials && high - low > kTimeTolerance; ++i) {
    const bool secant = at_low > kGuardTolerance;
    const double t =
        secant ? high - at_high * (high - low) / (at_high - at_low) : 0.5 * (low + high);
    const double at_t = value(t);
    if (secant && std::abs(at_t) <= kGuardTolerance) return t;
    if (at_t > 0) {
      low = t;
      at_low = at_t;
      low_stays = 0;
      if (++high_stays > 1) at_high *= 0.5;
    } else {
      high = t;
      at_high = at_t;
      high_stays = 0;
      if (++low_stays > 1) at_low *= 0.5;
    }
  }
  return high;
}

enum class Outcome { kStop, kStrike, kStumble };

struct Incident {
  double time = 0;
  Outcome outcome = Outcome::kStop;
};

// A strike or stumble of the swing foot within a step of length h, if any.
bool foot_incident(const Motion& motion, const Node& from, const Node& to, double h,
                   Incident& incident) {
  const SwingFoot &before = from.foot, &after = to.foot;
  if (after.lead <= 0) return false;
  double ahead_since = 0;
  SwingFoot entry = before;
  if (before.lead <= 0) {
    if (std::min(before.height, after.height) > 0) return false;
    ahead_since = locate(motion, Guard::kFootBehind, from, 0, h);
    entry = motion.step(from, ahead_since).foot;
  }
  if (entry.height < -kGuardTolerance) {
    incident = {ahead_since, entry.height_rate < 0 ? Outcome::kStrike : Outcome::kStumble};
    return true;
  }
  if (after.height > 0) return false;
  incident = {locate(motion, Guard::kFootHeight, from, ahead_since, h), Outcome::kStrike};
  return true;
}

// The first event within a step, if any.
bool first_incident(const Motion& motion, const Node& from, const Node& to, double h,
                    Incident& first) {
  bool found = foot_incident(motion, from, to, h, first);
  for (const Guard knee : {Guard::kStanceKnee, Guard::kSwingKnee}) {
    if (guard_value(knee, to) >= -kGuardTolerance) continue;
    const double time = locate(motion, knee, from, 0, h);
    if (found && first.time <= time) continue;
    first = {time, Outcome::kStop};
    found = true;
  }
  return found;
}

bool is_finite(const Node& node) {
  return node.state.q.allFinite() && node.state.qd.allFinite() &&
         node.state.qd.cwiseAbs().maxCoeff() < kMaxRate && node.acceleration.qdd.allFinite();
}

bool has_fallen(const KneedModel& model, const KneedState& s, const KneedLimits& limits) {
  const KneedParameters& p = model.parameters;
  const double hip_height =
      p.foot_radius + (p.shank_length - p.foot_up) * std::cos(s.q[kStanceShank]) +
      p.foot_forward * std::sin(s.q[kStanceShank]) + p.thigh_length * std::cos(s.q[kStanceThigh]);
  return hip_height < limits.min_hip_height * standing_hip_height(p) ||
         std::abs(s.q[kTorso]) > limits.max_torso_lean;
}

// Keeps the least local minimum of the swing foot's height: between falling and rising the height
// is taken as a parabola.
void note_clearance(const Node& from, Node& to) {
  const double fall = from.foot.height_rate, rise = to.foot.height_rate;
  if (fall >= 0 || rise <= 0) return;
  const double h = to.state.since_transfer - from.state.since_transfer;
  const double least = from.foot.height - 0.5 * fall * fall * h / (rise - fall);
  to.state.clearance = std::min(to.state.clearance, least);
}

void transfer(const Motion& motion, KneedState& state, KneedAdvance& result) {
  const bool hasty = state.since_transfer < kHastyTransfer && state.transfers > 0;
  const int hasty_transfers = hasty ? state.hasty_transfers + 1 : 0;
  const KneedTransfer change =
      kneed_support_transfer(motion.model, motion.controls.toe_off_impulse, state);
  result.event = KneedEvent::kDiverged;
  if (hasty_transfers > kMaxHastyTransfers || !change.state.qd.allFinite()) return;
  result.event = KneedEvent::kTransfer;
  result.impulse = change.impulse;
  result.step_length = kneed_swing_foot(motion.model, state).lead;
  result.clearance = state.clearance;
  state = change.state;
  state.hasty_transfers = hasty_transfers;
  settle_knee_stops(motion.model, motion.controls, motion.noise, state);
}

}  // namespace

KneedAdvance kneed_advance(const KneedModel& model, const KneedControls& controls,
                           const Vector5& noise, KneedState& state, double duration,
                           const KneedLimits& limits) {
  const Motion motion{model, controls, noise};
  KneedAdvance result;
  settle_knee_stops(model, controls, noise, state);
  const double step = kneed_step_size(model, controls, state, limits.max_step);
  Node node = motion.node(state);
  if (!is_finite(node) || !(step >= kMinStep)) {
    result.event = KneedEvent::kDiverged;
    return result;
  }
  int stop_events = 0;
  while (result.elapsed < duration) {
    const double remaining = duration - result.elapsed;
    double h = remaining / std::ceil(remaining / step);
    Node next = motion.step(node, h);
    if (!is_finite(next)) {
      result.event = KneedEvent::kDiverged;
      break;
    }
    Incident incident;
    const bool happens = first_incident(motion, node, next, h, incident);
    if (happens) {
      h = incident.time;
      next = motion.step(node, h);
    }
    note_clearance(node, next);
    node = next;
    result.elapsed = h == remaining ? duration : result.elapsed + h;
    if ((happens && incident.outcome == Outcome::kStumble) ||
        has_fallen(model, node.state, limits)) {
      result.event = KneedEvent::kFallen;
      break;
    }
    if (!happens) continue;
    if (incident.outcome == Outcome::kStrike) {
      transfer(motion, node.state, result);
      break;
    }
    settle_knee_stops(model, controls, noise, node.state);
    node = motion.node(node.state);
    if (++stop_events > kMaxStopEvents) {
      result.event = KneedEvent::kDiverged;
      break;
    }
  }
  state = node.state;
  return result;
}

}  // namespace walktrack
