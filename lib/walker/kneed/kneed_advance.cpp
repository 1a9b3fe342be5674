#include "walker/kneed/kneed_advance.h"

#include <algorithm>
#include <cmath>

#include "walker/kneed/kneed_incidents.h"
#include "walker/kneed/kneed_stops.h"

namespace walktrack {
inline namespace walker {
namespace {

constexpr double kHastyTransfer = 0.02;  // s; by hand: a step takes more than ten times as long
constexpr int kMaxHastyTransfers = 8;    // in a row; by hand

// A point of the trajectory with its acceleration and swing foot.
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

  // One RK4 step with constant stops.
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

double guard_value(KneedGuard guard, const Node& node) {
  const KneedState& s = node.state;
  switch (guard) {
    case KneedGuard::kStanceKnee:
      return s.stance_stop ? node.acceleration.stop_torque[0]
                           : s.q[kStanceShank] - s.q[kStanceThigh];
    case KneedGuard::kSwingKnee:
      return s.swing_stop ? node.acceleration.stop_torque[1] : s.q[kSwingShank] - s.q[kSwingThigh];
    case KneedGuard::kFootHeight:
      return node.foot.height;
    case KneedGuard::kFootBehind:
      return -node.foot.lead;
  }
  return 0;
}

// The time in (begin, end] at which the guard, which is positive before and not positive at `end`,
// reaches zero.
double locate(const Motion& motion, KneedGuard guard, const Node& from, double begin, double end) {
  const auto value = [&](double t) {
    return guard_value(guard, t == 0 ? from : motion.step(from, t));
  };
  FallSearch search(begin, value(begin), end, value(end));
  while (!search.done()) search.take(value(search.trial()));
  return search.root();
}

// A strike or stumble of the swing foot within a step of length h, if any.
bool foot_incident(const Motion& motion, const Node& from, const Node& to, double h,
                   Incident& incident) {
  const SwingFoot &before = from.foot, &after = to.foot;
  if (after.lead <= 0) return false;
  double ahead_since = 0;
  SwingFoot entry = before;
  if (before.lead <= 0) {
    if (std::min(before.height, after.height) > 0) return false;
    ahead_since = locate(motion, KneedGuard::kFootBehind, from, 0, h);
    entry = motion.step(from, ahead_since).foot;
  }
  if (entry.height < -kGuardTolerance) {
    incident = {ahead_since,
                entry.height_rate < 0 ? IncidentKind::kStrike : IncidentKind::kStumble};
    return true;
  }
  if (after.height > 0) return false;
  incident = {locate(motion, KneedGuard::kFootHeight, from, ahead_since, h), IncidentKind::kStrike};
  return true;
}

// The first event within a step, if there is any.
bool first_incident(const Motion& motion, const Node& from, const Node& to, double h,
                    Incident& first) {
  bool found = foot_incident(motion, from, to, h, first);
  for (const KneedGuard knee : {KneedGuard::kStanceKnee, KneedGuard::kSwingKnee}) {
    if (guard_value(knee, to) >= -kGuardTolerance) continue;
    const double time = locate(motion, knee, from, 0, h);
    if (found && first.time <= time) continue;
    first = {time, IncidentKind::kStop};
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

// Updates the lowest local minimum of the swing foot's height: between falling and rising the
// height is approximated by a parabola.
void note_clearance(const Node& from, Node& to) {
  const double fall = from.foot.height_rate, rise = to.foot.height_rate;
  if (fall >= 0 || rise <= 0) return;
  const double h = to.state.since_transfer - from.state.since_transfer;
  const double least = from.foot.height - 0.5 * fall * fall * h / (rise - fall);
  to.state.clearance = std::min(to.state.clearance, least);
}

}  // namespace

void transfer_support(const KneedModel& model, const KneedControls& controls, const Vector5& noise,
                      KneedState& state, KneedAdvance& result) {
  const bool hasty = state.since_transfer < kHastyTransfer && state.transfers > 0;
  const int hasty_transfers = hasty ? state.hasty_transfers + 1 : 0;
  const KneedTransfer change = kneed_support_transfer(model, controls.toe_off_impulse, state);
  result.event = KneedEvent::kDiverged;
  if (hasty_transfers > kMaxHastyTransfers || !change.state.qd.allFinite()) return;
  result.event = KneedEvent::kTransfer;
  result.impulse = change.impulse;
  result.step_length = kneed_swing_foot(model, state).lead;
  result.clearance = state.clearance;
  state = change.state;
  state.hasty_transfers = hasty_transfers;
  settle_knee_stops(model, controls, noise, state);
}

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
    if ((happens && incident.kind == IncidentKind::kStumble) ||
        has_fallen(model, node.state, limits)) {
      result.event = KneedEvent::kFallen;
      break;
    }
    if (!happens) continue;
    if (incident.kind == IncidentKind::kStrike) {
      transfer_support(model, controls, noise, node.state, result);
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

}  // namespace walker
}  // namespace walktrack
