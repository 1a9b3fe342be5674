#include "walker/linkage/linkage_walker.h"

#include <utility>

namespace walktrack {
inline namespace walker {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// The same point with additional coordinates.
PlanarPoint extended(const PlanarPoint& point, Index coordinates) {
  PlanarPoint result(coordinates);
  const Index n = point.along.size();
  result.constant = point.constant;
  result.along.head(n) = point.along;
  result.across.head(n) = point.across;
  result.linear.leftCols(n) = point.linear;
  return result;
}

// The arc centre of a foot that rolls: (R q, R).
PlanarPoint rolling_centre(Index coordinates, Index angle, double radius) {
  PlanarPoint centre(coordinates);
  centre.constant.y() = radius;
  centre.linear(0, angle) = radius;
  return centre;
}

PlanarPoint free_hip(Index n) {
  PlanarPoint hip(n + 2);
  hip.linear(0, n) = 1;
  hip.linear(1, n + 1) = 1;
  return hip;
}

}  // namespace

LinkageWalker::LinkageWalker(Linkage linkage)
    : linkage_(std::move(linkage)), n_(static_cast<Index>(linkage_.angles.size())) {
  const double radius = linkage_.foot_radius;
  on_stance_foot_ =
      placed(rolling_centre(n_, linkage_.stance_angle, radius) - linkage_.stance_foot, n_);
  on_swing_foot_ =
      placed(rolling_centre(n_, linkage_.swing_angle, radius) - linkage_.swing_foot, n_);
  in_flight_ = placed(free_hip(n_), n_ + 2);
}

LinkageWalker::Placed LinkageWalker::placed(const PlanarPoint& hip, Index coordinates) const {
  Placed result;
  result.hip = hip;
  result.stance_foot = hip + extended(linkage_.stance_foot, coordinates);
  result.swing_foot = hip + extended(linkage_.swing_foot, coordinates);
  for (PlanarPart part : linkage_.parts) {
    part.com = hip + extended(part.com, coordinates);
    result.parts.push_back(std::move(part));
  }
  return result;
}

WalkerState LinkageWalker::section_state(const VectorXd& q, const VectorXd& qd) const {
  WalkerState state;
  state.q = q;
  state.qd = qd;
  state.active = linkage_.latched ? 1u : 0u;
  state.contacts = {0.0, linkage_.foot_radius * q(linkage_.stance_angle)};
  return settled(state);
}

VectorXd LinkageWalker::section_point(const WalkerState& state) const {
  VectorXd x(2 * state.q.size());
  x << state.q, state.qd;
  return x;
}

std::vector<std::string> LinkageWalker::coordinates() const {
  std::vector<std::string> names = linkage_.angles;
  if (linkage_.may_fly) names.insert(names.end(), {"hip_x", "hip_z"});
  return names;
}

double LinkageWalker::weight() const {
  double mass = 0;
  for (const PlanarPart& part : linkage_.parts) mass += part.mass;
  return mass * linkage_.gravity.norm();
}

VectorXd LinkageWalker::spring_force(const WalkerState& state) const {
  VectorXd force = VectorXd::Zero(state.q.size());
  for (const LinkageSpring& spring : linkage_.springs) {
    const double torque = spring.stiffness * (spring.rest - spring.measure.dot(state.q.head(n_))) -
                          spring.damping * spring.measure.dot(state.qd.head(n_));
    force.head(n_) += torque * spring.pull;
  }
  return force;
}

VectorXd LinkageWalker::actuator_powers(const WalkerState& state) const {
  VectorXd powers(static_cast<Index>(linkage_.springs.size()));
  Index k = 0;
  for (const LinkageSpring& spring : linkage_.springs) {
    const double torque = spring.stiffness * (spring.rest - spring.measure.dot(state.q.head(n_))) -
                          spring.damping * spring.measure.dot(state.qd.head(n_));
    powers(k++) = torque * spring.pull.dot(state.qd.head(n_));
  }
  return powers;
}

TmtSystem LinkageWalker::system(const WalkerState& state) const {
  TmtSystem system = assemble(frame(state).parts, linkage_.gravity, state.q, state.qd);
  system.force += spring_force(state);
  return system;
}

std::vector<Limit> LinkageWalker::limits_for(const WalkerState& state) const {
  std::vector<Limit> limits = linkage_.limits;
  for (Limit& limit : limits) {
    limit.row.conservativeResizeLike(VectorXd::Zero(state.q.size()));
  }
  return limits;
}

// Between events an active limit is an equality: its force is watched by a guard.
std::vector<LimitRole> LinkageWalker::acting_roles(const WalkerState& state) const {
  std::vector<LimitRole> roles(linkage_.limits.size(), LimitRole::kFree);
  for (size_t i = 0; i < roles.size(); ++i) {
    if (state.active >> i & 1u) roles[i] = LimitRole::kLatched;
  }
  return roles;
}

LimitedMotion LinkageWalker::limited_motion(const WalkerState& state) const {
  const TmtSystem now = system(state);
  return solve_limited(now.mass, now.force, limits_for(state), acting_roles(state));
}

VectorXd LinkageWalker::acceleration(const WalkerState& state) const {
  return limited_motion(state).rate;
}

double LinkageWalker::normal_force(const WalkerState& state) const {
  return outer_force(frame(state).parts, linkage_.gravity, state.q, state.qd, acceleration(state))
      .y();
}

std::vector<ContactForce> LinkageWalker::contact_forces(const WalkerState& state) const {
  if (state.phase != kStance) return {};
  const double x = state.contacts[0] + position(frame(state).stance_foot, state.q).x();
  return {{Vector2d(x, 0), outer_force(frame(state).parts, linkage_.gravity, state.q, state.qd,
                                       acceleration(state))}};
}

WalkerEnergy LinkageWalker::energy(const WalkerState& state) const {
  const PlanarEnergy mechanical =
      mechanical_energy(frame(state).parts, linkage_.gravity, state.q, state.qd);
  WalkerEnergy energy{mechanical.kinetic, mechanical.potential, 0};
  if (state.phase == kStance) {
    double mass = 0;
    for (const PlanarPart& part : linkage_.parts) mass += part.mass;
    energy.gravity -= mass * linkage_.gravity.x() * state.contacts[0];
  }
  for (const LinkageSpring& spring : linkage_.springs) {
    if (spring.pull != spring.measure) continue;
    const double stretch = spring.measure.dot(state.q.head(n_)) - spring.rest;
    energy.elastic += 0.5 * spring.stiffness * stretch * stretch;
  }
  return energy;
}

PlanarMomentum LinkageWalker::momentum(const WalkerState& state) const {
  PlanarMomentum result = walktrack::momentum(frame(state).parts, state.q, state.qd);
  if (state.phase == kStance) result.com.x() += state.contacts[0];
  return result;
}

double LinkageWalker::foot_height(const WalkerState& state, bool swing) const {
  const Placed& now = frame(state);
  return position(swing ? now.swing_foot : now.stance_foot, state.q).y() - linkage_.foot_radius;
}

double LinkageWalker::swing_lead(const WalkerState& state) const {
  const Placed& now = frame(state);
  return position(now.swing_foot, state.q).x() - position(now.stance_foot, state.q).x();
}

std::vector<Stroke> LinkageWalker::strokes(const WalkerState& state) const {
  const Placed& now = frame(state);
  const double x = state.phase == kStance ? state.contacts[0] : 0.0;
  const Vector2d hip = position(now.hip, state.q) + Vector2d(x, 0);
  const VectorXd angles = state.q.head(n_);
  std::vector<Stroke> strokes;
  for (const Linkage::Line& line : linkage_.lines) {
    strokes.push_back(
        {hip + position(line.from, angles), hip + position(line.to, angles), line.group});
  }
  return strokes;
}

}  // namespace walker
}  // namespace walktrack
