#include "walker/kneed/kneed_lane_walkers.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace walktrack {
inline namespace walker {
namespace {

double guard_value(KneedGuard guard, const Lanes& lanes, const LanePoint& at, size_t lane) {
  switch (guard) {
    case KneedGuard::kStanceKnee:
      return lanes.held[0][lane] != 0 ? at.stop_torque[0][lane] : at.q[3][lane];
    case KneedGuard::kSwingKnee:
      return lanes.held[1][lane] != 0 ? at.stop_torque[1][lane] : at.q[4][lane];
    case KneedGuard::kFootHeight:
      return at.height[0][lane];
    case KneedGuard::kFootBehind:
      return -at.lead[0][lane];
  }
  return 0;
}

}  // namespace

LaneModel lane_model(const KneedModel& model) {
  const KneedParameters& p = model.parameters;
  LaneModel m{};
  for (int k = 0; k < 5; ++k) {
    m.along[k] = model.along_moment[k];
    m.across[k] = model.across_moment[k];
    m.diagonal[k] = model.couple(k, k);
  }
  m.shank_along = p.shank_length - p.foot_up;
  m.shank_across = -p.foot_forward;
  m.thigh = p.thigh_length;
  m.radius = p.foot_radius;
  m.mass = model.total_mass;
  m.gravity_x = model.gravity.x();
  m.gravity_z = model.gravity.y();
  return m;
}

void load_forces(const KneedControls& controls, const Vector5& noise, size_t lane, Lanes& lanes) {
  const std::array<const SpringDamper*, 4> springs{&controls.torso, &controls.hip,
                                                   &controls.stance_knee, &controls.swing_knee};
  for (size_t i = 0; i < 4; ++i) {
    lanes.forces.stiffness[i][lane] = springs[i]->stiffness;
    lanes.forces.damping[i][lane] = springs[i]->damping;
    lanes.forces.offset[i][lane] = springs[i]->stiffness * springs[i]->rest;
  }
  lanes.forces.noise[0][lane] = noise[kTorso];
  lanes.forces.noise[1][lane] = noise[kStanceThigh] + noise[kStanceShank];
  lanes.forces.noise[2][lane] = noise[kSwingThigh] + noise[kSwingShank];
  lanes.forces.noise[3][lane] = noise[kStanceShank];
  lanes.forces.noise[4][lane] = noise[kSwingShank];
}

void load_state(const KneedState& s, size_t lane, Lanes& lanes) {
  const std::array<bool, 2> held{s.stance_stop, s.swing_stop};
  for (size_t k = 0; k < 3; ++k) {
    lanes.at.q[k][lane] = s.q[static_cast<Eigen::Index>(k)];
    lanes.at.qd[k][lane] = s.qd[static_cast<Eigen::Index>(k)];
  }
  for (size_t knee = 0; knee < 2; ++knee) {
    const auto thigh = static_cast<Eigen::Index>(1 + knee), shank = thigh + 2;
    const double angle = s.q[shank] - s.q[thigh], rate = s.qd[shank] - s.qd[thigh];
    const bool rests = held[knee] && std::abs(angle) <= kAtStop && std::abs(rate) <= kAtRest;
    lanes.at.q[3 + knee][lane] = rests ? 0 : angle;
    lanes.at.qd[3 + knee][lane] = rests ? 0 : rate;
    lanes.held[knee][lane] = held[knee] ? 1 : 0;
  }
  lanes.since[0][lane] = s.since_transfer;
  lanes.clearance[0][lane] = s.clearance;
}

void store_state(const Lanes& lanes, size_t lane, KneedState& s) {
  for (size_t k = 0; k < 3; ++k) {
    s.q[static_cast<Eigen::Index>(k)] = lanes.at.q[k][lane];
    s.qd[static_cast<Eigen::Index>(k)] = lanes.at.qd[k][lane];
  }
  for (size_t knee = 0; knee < 2; ++knee) {
    const auto thigh = static_cast<Eigen::Index>(1 + knee), shank = thigh + 2;
    s.q[shank] = s.q[thigh] + lanes.at.q[3 + knee][lane];
    s.qd[shank] = s.qd[thigh] + lanes.at.qd[3 + knee][lane];
  }
  s.since_transfer = lanes.since[0][lane];
  s.clearance = lanes.clearance[0][lane];
}

bool is_settled(const Lanes& lanes, size_t lane) {
  for (size_t knee = 0; knee < 2; ++knee) {
    const double angle = lanes.at.q[3 + knee][lane], rate = lanes.at.qd[3 + knee][lane];
    const bool held = lanes.held[knee][lane] != 0;
    const bool fine =
        held ? angle == 0 && rate == 0 && lanes.at.stop_torque[knee][lane] >= 0 : angle > kAtStop;
    if (!fine) return false;
  }
  return true;
}

bool is_sound(const LanePoint& at, size_t lane) {
  double sum = 0, fastest = 0;
  for (size_t k = 0; k < 5; ++k) {
    sum += std::abs(at.q[k][lane]) + std::abs(at.qdd[k][lane]) + std::abs(at.qd[k][lane]);
    fastest = std::max(fastest, std::abs(at.qd[k][lane]));
  }
  return std::isfinite(sum) && fastest < kMaxRate;
}

LaneIncident::LaneIncident(const Lanes& lanes, const LanePoint& end, size_t lane, double h)
    : lane_(lane), h_(h) {
  const double height = lanes.at.height[0][lane];
  if (end.lead[0][lane] > 0) {
    if (lanes.at.lead[0][lane] > 0)
      foot_ahead(height, lanes.at.height_rate[0][lane], end);
    else if (std::min(height, end.height[0][lane]) <= 0)
      pending_[static_cast<size_t>(KneedGuard::kFootBehind)] = true;
  }
  height_then_ = height;
  for (const KneedGuard knee : {KneedGuard::kStanceKnee, KneedGuard::kSwingKnee})
    pending_[static_cast<size_t>(knee)] = guard_value(knee, lanes, end, lane) < -kGuardTolerance;
  start_next(lanes, end);
}

void LaneIncident::note(double time, IncidentKind kind) {
  if (found_ && first_.time <= time) return;
  first_ = {time, kind};
  found_ = true;
}

// The foot has passed the stance foot: decides whether it strikes at once or later.
void LaneIncident::foot_ahead(double height, double height_rate, const LanePoint& end) {
  if (height < -kGuardTolerance)
    note(ahead_since_, height_rate < 0 ? IncidentKind::kStrike : IncidentKind::kStumble);
  else if (end.height[0][lane_] <= 0)
    pending_[static_cast<size_t>(KneedGuard::kFootHeight)] = true;
}

void LaneIncident::start_next(const Lanes& lanes, const LanePoint& end) {
  searching_ = false;
  for (const KneedGuard guard : {KneedGuard::kFootBehind, KneedGuard::kFootHeight,
                                 KneedGuard::kStanceKnee, KneedGuard::kSwingKnee}) {
    bool& waits = pending_[static_cast<size_t>(guard)];
    if (!waits) continue;
    waits = false;
    current_ = guard;
    const bool foot = guard == KneedGuard::kFootHeight;
    search_ = {foot ? ahead_since_ : 0,
               foot ? height_then_ : guard_value(guard, lanes, lanes.at, lane_), h_,
               guard_value(guard, lanes, end, lane_)};
    searching_ = true;
    return;
  }
}

double LaneIncident::trial() const {
  if (!searching_) return 0;
  return search_.done() ? search_.root() : search_.trial();
}

void LaneIncident::take(const Lanes& lanes, const LanePoint& at, const LanePoint& end) {
  const bool behind = current_ == KneedGuard::kFootBehind;
  if (!search_.done()) {
    search_.take(guard_value(current_, lanes, at, lane_));
    // The foot's height is needed at the time of passing: one more evaluation, at the root.
    if (behind || !search_.done()) return;
  }
  if (behind) {
    ahead_since_ = search_.root();
    height_then_ = at.height[0][lane_];
    foot_ahead(height_then_, at.height_rate[0][lane_], end);
  } else {
    const bool foot = current_ == KneedGuard::kFootHeight;
    note(search_.root(), foot ? IncidentKind::kStrike : IncidentKind::kStop);
  }
  start_next(lanes, end);
}

}  // namespace walker
}  // namespace walktrack
