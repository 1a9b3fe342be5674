#include "walker/monopode.h"

#include <cmath>

namespace walktrack {
inline namespace walker {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

enum MonopodeGuard { kApexGuard, kLanding, kFall, kFirstFoot };

// Below this height of the mass, in leg lengths, the monopode has fallen. By hand.
constexpr double kFallenMonopodeShare = 0.3;

size_t feet(const WalkerState& state) { return state.contacts.size() - 1; }

PlanarPoint mass_point() {
  PlanarPoint point(2);
  point.linear.setIdentity();
  return point;
}

}  // namespace

Monopode::Monopode(const MonopodeParameters& parameters)
    : parameters_(parameters), parts_{{parameters.mass, 0, mass_point(), -1}} {}

Vector2d Monopode::leg_force(const WalkerState& state, double foot) const {
  const Vector2d leg = state.q - Vector2d(foot, 0);
  const double length = leg.norm();
  return parameters_.stiffness * (parameters_.leg_length - length) / length * leg;
}

VectorXd Monopode::acceleration(const WalkerState& state) const {
  TmtSystem system = assemble(parts_, {0, -parameters_.gravity}, state.q, state.qd);
  for (size_t i = 0; i < feet(state); ++i) {
    system.force += leg_force(state, state.contacts[i + 1]);
  }
  return solve_mass(system.mass, system.force);
}

std::vector<Guard> Monopode::guards(const WalkerState& state) const {
  const MonopodeParameters& p = parameters_;
  std::vector<Guard> guards{
      {kFall, state.q.y() - kFallenMonopodeShare * p.leg_length, state.qd.y()}};
  const size_t section_feet = p.walks ? 1 : 0;
  if (state.active == 0 && feet(state) == section_feet) {
    guards.push_back({kApexGuard, state.qd.y(), acceleration(state).y()});
  }
  if (feet(state) == 0 || (p.walks && feet(state) == 1)) {
    guards.push_back({kLanding, state.q.y() - p.leg_length * std::sin(p.attack), state.qd.y()});
  }
  for (size_t i = 0; i < feet(state); ++i) {
    const Vector2d leg = state.q - Vector2d(state.contacts[i + 1], 0);
    guards.push_back({kFirstFoot + static_cast<int>(i), p.leg_length - leg.norm(),
                      -leg.dot(state.qd) / leg.norm()});
  }
  return guards;
}

WalkerState Monopode::landed(const WalkerState& state) const {
  WalkerState after = state;
  after.active = 0;
  after.contacts.push_back(state.q.x() + parameters_.leg_length * std::cos(parameters_.attack));
  after.phase = static_cast<int>(feet(after));
  return after;
}

std::optional<Transition> Monopode::event(int id, const WalkerState& state) const {
  Transition transition{.after = state};
  switch (id) {
    case kApexGuard: {
      const double here = parameters_.walks ? state.contacts[1] : state.q.x();
      transition.kind = EventKind::kApex;
      transition.advance = here - state.contacts[0];
      transition.feet_apart = transition.advance;
      transition.completes_step = true;
      transition.after.contacts[0] = here;
      transition.after.active = 1;
      return transition;
    }
    case kLanding:
      if (state.qd.y() >= 0) return std::nullopt;
      transition.kind = EventKind::kStrike;
      transition.after = landed(state);
      return transition;
    case kFall:
      transition.kind = EventKind::kFall;
      transition.after.health = Health::kFallen;
      return transition;
    default:
      transition.kind = EventKind::kTakeOff;
      transition.index = id - kFirstFoot;
      transition.after.contacts.erase(transition.after.contacts.begin() + 1 + transition.index);
      transition.after.phase = static_cast<int>(feet(transition.after));
      return transition;
  }
}

WalkerEnergy Monopode::energy(const WalkerState& state) const {
  const PlanarEnergy mechanical =
      mechanical_energy(parts_, {0, -parameters_.gravity}, state.q, state.qd);
  WalkerEnergy energy{mechanical.kinetic, mechanical.potential, 0};
  for (size_t i = 0; i < feet(state); ++i) {
    const double length = (state.q - Vector2d(state.contacts[i + 1], 0)).norm();
    const double shortening = parameters_.leg_length - length;
    energy.elastic += 0.5 * parameters_.stiffness * shortening * shortening;
  }
  return energy;
}

std::vector<ContactForce> Monopode::contact_forces(const WalkerState& state) const {
  std::vector<ContactForce> forces;
  for (size_t i = 0; i < feet(state); ++i) {
    const double foot = state.contacts[i + 1];
    forces.push_back({Vector2d(foot, 0), leg_force(state, foot)});
  }
  return forces;
}

PlanarMomentum Monopode::momentum(const WalkerState& state) const {
  return walktrack::momentum(parts_, state.q, state.qd);
}

std::vector<Stroke> Monopode::strokes(const WalkerState& state) const {
  const MonopodeParameters& p = parameters_;
  std::vector<Stroke> strokes;
  for (size_t i = 0; i < feet(state); ++i) {
    strokes.push_back({Vector2d(state.contacts[i + 1], 0), state.q, 1 + static_cast<int>(i)});
  }
  if (feet(state) == 0) {
    const Vector2d leg = p.leg_length * Vector2d(std::cos(p.attack), -std::sin(p.attack));
    strokes.push_back({state.q, state.q + leg, 2});
  }
  return strokes;
}

std::optional<VectorXd> Monopode::apex(double height, double ahead, double energy) const {
  VectorXd x = VectorXd::Zero(4);
  x.head<2>() << (parameters_.walks ? ahead : 0.0), height;
  const double left = energy - this->energy(section_state(x.head(2), x.tail(2))).total();
  if (left < 0) return std::nullopt;
  x(2) = std::sqrt(2 * left / parameters_.mass);
  return x;
}

WalkerState Monopode::section_state(const VectorXd& q, const VectorXd& qd) const {
  WalkerState state;
  state.q = q;
  state.qd = qd;
  state.contacts = {0.0};
  if (parameters_.walks) state.contacts.push_back(0.0);
  state.phase = static_cast<int>(feet(state));
  state.active = 1;
  if (q.y() < kFallenMonopodeShare * parameters_.leg_length) state.health = Health::kFallen;
  return state;
}

VectorXd Monopode::section_point(const WalkerState& state) const {
  VectorXd x(4);
  x << state.q.x() - state.contacts[0], state.q.y(), state.qd;
  return x;
}

MatrixXd Monopode::section_rows(const WalkerState& state) const {
  const int count = parameters_.walks ? 2 : 3;
  MatrixXd rows = MatrixXd::Zero(count, 4);
  // d(energy) = -(sum of forces) dq + m qd dqd, in units of the weight.
  rows.row(0).head<2>() = -acceleration(state).transpose() / parameters_.gravity;
  rows.row(0).tail<2>() = state.qd.transpose() / parameters_.gravity;
  rows(1, 3) = 1;
  if (!parameters_.walks) rows(2, 0) = 1;
  return rows;
}

}  // namespace walker
}  // namespace walktrack
