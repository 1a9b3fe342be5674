// Events of a LinkageWalker: limits, strike, take-off, fall.
#include <cmath>

#include "walker/linkage/linkage_walker.h"

namespace walktrack {
inline namespace walker {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

enum LinkageGuard { kSwingFoot, kPassing, kNormalForce, kHip, kStanceFoot, kFirstLimit };

// A limit is touched if its gap is within rounding of an event's location. It is at rest if its
// rate is that after a plastic impulse, or the tiny rebound after it: one of 1e-6 rad/s lasts
// nanoseconds and rises 1e-14 rad if a knee is pushed back at 100 rad/s^2.
constexpr double kTouching = 1e-9;  // rad
constexpr double kResting = 1e-6;   // rad/s
constexpr double kStill = 1e-9;     // rad/s, rounding of an impulse

// A foot is in front if its lead exceeds the uncertainty of an event's location: straight legs meet
// at ground level exactly when they pass each other.
constexpr double kAhead = 1e-9;  // m

bool acts(const WalkerState& state, size_t limit) { return (state.active >> limit & 1u) != 0; }

double rate_of(const PlanarPoint& point, const WalkerState& state, Index axis) {
  return jacobian(point, state.q).row(axis).dot(state.qd);
}

}  // namespace

double LinkageWalker::gap(const WalkerState& state, size_t limit) const {
  return linkage_.limits[limit].row.dot(state.q.head(n_)) - linkage_.limits[limit].bound;
}

double LinkageWalker::gap_rate(const WalkerState& state, size_t limit) const {
  return linkage_.limits[limit].row.dot(state.qd.head(n_));
}

bool LinkageWalker::is_latched(const WalkerState& state, size_t limit) const {
  return linkage_.latched && limit < 2 && acts(state, limit);
}

// [M -a; a' 0][qd+; rho] = [M qd-; 0] for every limit that touches.
WalkerState LinkageWalker::with_plastic_stops(WalkerState state) const {
  std::vector<LimitRole> roles(linkage_.limits.size(), LimitRole::kFree);
  bool any = false;
  for (size_t i = 0; i < roles.size(); ++i) {
    if (is_latched(state, i)) {
      roles[i] = LimitRole::kLatched;
    } else if (gap(state, i) <= kTouching) {
      roles[i] = LimitRole::kStop;
    } else {
      continue;
    }
    any = any || gap_rate(state, i) < 0 || roles[i] == LimitRole::kLatched;
  }
  if (!any) return state;
  const MatrixXd mass = assemble(frame(state).parts, linkage_.gravity, state.q, state.qd).mass;
  state.qd = solve_limited(mass, mass * state.qd, limits_for(state), roles).rate;
  return state;
}

WalkerState LinkageWalker::settled(WalkerState state) const {
  if (state.health != Health::kSound) return state;
  if (position(frame(state).hip, state.q).y() < linkage_.lowest_hip) {
    state.health = Health::kFallen;
    return state;
  }
  for (size_t i = 0; i < linkage_.limits.size(); ++i) {
    const double excess = gap(state, i);
    const VectorXd& row = linkage_.limits[i].row;
    if (excess < 0 || is_latched(state, i)) state.q.head(n_) -= excess / row.squaredNorm() * row;
  }
  state = with_plastic_stops(std::move(state));
  // A stop is active from now on if it is touched, at rest and pushing.
  std::vector<LimitRole> roles(linkage_.limits.size(), LimitRole::kFree);
  for (size_t i = 0; i < roles.size(); ++i) {
    const bool rests = gap(state, i) <= kTouching && std::abs(gap_rate(state, i)) <= kResting;
    if (is_latched(state, i)) {
      roles[i] = LimitRole::kLatched;
    } else if (rests) {
      roles[i] = LimitRole::kStop;
    }
  }
  const TmtSystem now = system(state);
  const LimitedMotion motion = solve_limited(now.mass, now.force, limits_for(state), roles);
  bool rebounds = false;
  for (size_t i = 0; i < roles.size(); ++i) {
    const bool on = roles[i] == LimitRole::kLatched || motion.force(static_cast<Index>(i)) > 0;
    state.active = (state.active & ~(1u << i)) | (on ? 1u << i : 0u);
    rebounds = rebounds || (on && std::abs(gap_rate(state, i)) > kStill);
  }
  // Walkers at rest remain at rest: the rest of the rebound is removed.
  if (rebounds) {
    state.qd =
        solve_limited(now.mass, now.mass * state.qd, limits_for(state), acting_roles(state)).rate;
  }
  if (linkage_.may_fly && state.phase == kStance && normal_force(state) < 0) {
    double work = 0;
    return taken_off(state, work);
  }
  return state;
}

std::vector<Guard> LinkageWalker::guards(const WalkerState& state) const {
  const Placed& now = frame(state);
  std::vector<Guard> guards{
      {kSwingFoot, foot_height(state, true), rate_of(now.swing_foot, state, 1)},
      {kHip, position(now.hip, state.q).y() - linkage_.lowest_hip, rate_of(now.hip, state, 1)}};
  if (state.phase == kFlight) {
    guards.push_back({kStanceFoot, foot_height(state, false), rate_of(now.stance_foot, state, 1)});
  } else {
    const double lead_rate = rate_of(now.swing_foot, state, 0) - rate_of(now.stance_foot, state, 0);
    if (!linkage_.may_scuff) guards.push_back({kPassing, -swing_lead(state), -lead_rate});
    if (linkage_.may_fly) guards.push_back({kNormalForce, normal_force(state), std::nullopt});
  }
  LimitedMotion motion;
  if (state.active != 0) motion = limited_motion(state);
  for (size_t i = 0; i < linkage_.limits.size(); ++i) {
    const int id = kFirstLimit + static_cast<int>(i);
    if (!acts(state, i)) {
      guards.push_back({id, gap(state, i), gap_rate(state, i)});
    } else if (!is_latched(state, i)) {
      guards.push_back({id, motion.force(static_cast<Index>(i)), std::nullopt});
    }
  }
  return guards;
}

Transition LinkageWalker::stopped(const WalkerState& state, size_t limit) const {
  Transition transition{.kind = EventKind::kStop, .index = static_cast<int>(limit), .after = state};
  if (acts(state, limit)) {
    // The stop would have to pull: it is released, and the others may change as well.
    transition.kind = EventKind::kRelease;
    transition.after.active &= ~(1u << limit);
    WalkerState others = settled(transition.after);
    others.active &= ~(1u << limit);
    transition.after = others;
    return transition;
  }
  if (linkage_.latched && limit < 2) transition.after.active |= 1u << limit;
  transition.after = settled(transition.after);
  return transition;
}

WalkerState LinkageWalker::taken_off(const WalkerState& state, double& work) const {
  WalkerState flying = state;
  const Vector2d hip = position(on_stance_foot_.hip, state.q) + Vector2d(state.contacts[0], 0);
  const Vector2d hip_rate = jacobian(on_stance_foot_.hip, state.q) * state.qd;
  flying.phase = kFlight;
  flying.q.conservativeResize(n_ + 2);
  flying.qd.conservativeResize(n_ + 2);
  flying.q.tail<2>() = hip;
  flying.qd.tail<2>() = hip_rate;
  if (linkage_.toe_off_impulse > 0) {
    const ToeOff push = toe_off(in_flight_, in_flight_.stance_foot, flying.q);
    const Vector2d before = push.lever * flying.qd;
    const TmtSystem now = assemble(in_flight_.parts, linkage_.gravity, flying.q, flying.qd);
    flying.qd = solve_limited(now.mass, now.mass * flying.qd + push.generalised, limits_for(flying),
                              acting_roles(flying))
                    .rate;
    work = push.impulse.dot(before + push.lever * flying.qd) / 2;
  }
  return settled(flying);
}

// The direction is computed from the foot relative to the hip, and the generalised impulse before
// any rounding of its length: along a straight leg the products cancel exactly, which matters for
// light legs.
LinkageWalker::ToeOff LinkageWalker::toe_off(const Placed& placed, const PlanarPoint& foot,
                                             const VectorXd& q) const {
  ToeOff push;
  push.lever = jacobian(foot, q);
  const Vector2d towards = position(placed.hip - foot, q);
  const double distance = towards.norm();
  const double scale = distance > 0 ? linkage_.toe_off_impulse / distance : 0.0;
  push.impulse = scale * towards;
  push.generalised = push.lever.transpose() * towards;
  push.generalised *= scale;
  return push;
}

// The rates at a strike, before the legs swap, and the impulses that change them.
void LinkageWalker::transfer_support(const WalkerState& state, bool swing, WalkerState& stance,
                                     Transition& transition) const {
  const Placed& before = frame(state);
  const Placed& after = swing ? on_swing_foot_ : on_stance_foot_;
  const VectorXd masses = part_masses(before.parts);
  const VectorXd v = part_jacobian(before.parts, state.q) * state.qd;
  const MatrixXd T = part_jacobian(after.parts, stance.q);
  ToeOff push = toe_off(after, swing ? after.stance_foot : after.swing_foot, stance.q);
  if (!swing || state.phase == kFlight) {  // the old foot is in the air and cannot push
    push.impulse.setZero();
    push.generalised.setZero();
  }
  std::vector<LimitRole> roles(linkage_.limits.size(), LimitRole::kFree);
  for (size_t i = 0; i < roles.size(); ++i) {
    if (is_latched(state, i)) roles[i] = LimitRole::kLatched;
  }
  stance.qd = solve_limited(T.transpose() * masses.asDiagonal() * T,
                            T.transpose() * masses.cwiseProduct(v) + push.generalised,
                            limits_for(stance), roles)
                  .rate;

  const VectorXd jump = masses.cwiseProduct(T * stance.qd - v);
  for (Index i = 0; i < jump.size(); i += 3) transition.impulse += jump.segment<2>(i);
  transition.impulse -= push.impulse;
  const PlanarPoint& old_foot = swing ? before.stance_foot : before.swing_foot;
  const Vector2d old_before = jacobian(old_foot, state.q) * state.qd;
  const Vector2d old_after = push.lever * stance.qd;
  transition.actuator_work = push.impulse.dot(old_before + old_after) / 2;
  transition.old_foot_lifts = state.phase == kFlight || old_after.y() >= 0;
}

// The swing leg and the stance leg swap.
void LinkageWalker::mirror_legs(WalkerState& stance) const {
  VectorXd q(n_), qd(n_);
  for (Index i = 0; i < n_; ++i) {
    const Index from = linkage_.exchange[static_cast<size_t>(i)];
    q(i) = stance.q(from) + linkage_.shift(i);
    qd(i) = stance.qd(from);
  }
  stance.q = q;
  stance.qd = qd;
  stance.active = linkage_.latched ? 1u : 0u;
}

Transition LinkageWalker::strike(const WalkerState& state, bool swing) const {
  Transition transition;
  transition.index = swing ? 1 : 0;
  WalkerState stance = state;
  stance.phase = kStance;
  stance.q = state.q.head(n_);
  transfer_support(state, swing, stance, transition);

  const double origin = state.phase == kStance ? state.contacts[0] : 0.0;
  const PlanarPoint& landing = swing ? frame(state).swing_foot : frame(state).stance_foot;
  const double centre = origin + position(landing, state.q).x();
  if (swing) {
    transition.advance = centre - state.contacts[1];
    transition.feet_apart = swing_lead(state);
    transition.completes_step = true;
    mirror_legs(stance);
  }
  const double rolled = linkage_.foot_radius * stance.q(linkage_.stance_angle);
  stance.contacts = {centre - rolled, swing ? centre : state.contacts[1]};
  transition.after = settled(stance);
  return transition;
}

std::optional<Transition> LinkageWalker::event(int id, const WalkerState& state) const {
  const auto fallen = [&] {
    Transition fall{.kind = EventKind::kFall, .after = state};
    fall.after.health = Health::kFallen;
    return fall;
  };
  switch (id) {
    case kSwingFoot:
      if (state.phase == kStance && swing_lead(state) <= kAhead) return std::nullopt;
      break;
    case kPassing:
      if (foot_height(state, true) >= 0) return std::nullopt;
      if (rate_of(frame(state).swing_foot, state, 1) >= 0) return fallen();
      break;
    case kNormalForce: {
      Transition off{.kind = EventKind::kTakeOff, .after = state};
      off.after = taken_off(state, off.actuator_work);
      return off;
    }
    case kHip:
      return fallen();
    case kStanceFoot:
      return strike(state, false);
    default:
      return stopped(state, static_cast<size_t>(id - kFirstLimit));
  }
  // A latched walker cannot stand on a swing knee that is still flexed.
  if (linkage_.latched && !acts(state, 1)) return fallen();
  return strike(state, true);
}

MatrixXd LinkageWalker::section_rows(const WalkerState& state) const {
  const Index n = state.q.size();
  std::vector<VectorXd> rows;
  const auto add = [&](const VectorXd& row, Index at) {
    VectorXd whole = VectorXd::Zero(2 * n);
    whole.segment(at, row.size()) = row;
    rows.push_back(whole);
  };
  constexpr double kOnTheGround = 1e-6;  // m: a guess with six digits counts as standing
  if (std::abs(foot_height(state, true)) < kOnTheGround) {
    add(jacobian(frame(state).swing_foot, state.q).row(1).transpose(), 0);
  }
  for (size_t i = 0; i < linkage_.limits.size(); ++i) {
    if (gap(state, i) > kTouching) continue;
    add(linkage_.limits[i].row, 0);
    if (std::abs(gap_rate(state, i)) <= kResting) add(linkage_.limits[i].row, n);
  }
  MatrixXd result(static_cast<Index>(rows.size()), 2 * n);
  for (size_t i = 0; i < rows.size(); ++i) result.row(static_cast<Index>(i)) = rows[i].transpose();
  return result;
}

}  // namespace walker
}  // namespace walktrack
