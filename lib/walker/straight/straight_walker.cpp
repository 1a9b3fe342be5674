#include "walker/straight/straight_walker.h"

#include <cmath>

namespace walktrack {
inline namespace walker {
namespace {

// u(a) and w(a) of core/conventions.h.
struct Leg {
  Vector2 u, w;
  explicit Leg(double angle)
      : u(std::sin(angle), std::cos(angle)), w(std::cos(angle), -std::sin(angle)) {}
};

Eigen::Matrix2d mass_matrix(const StraightModel& m, const Leg& stance, const Leg& swing) {
  Eigen::Matrix2d mass;
  mass(0, 0) =
      m.stance_couple + m.radius * (m.radius * m.mass + 2 * m.stance_moment * stance.u.y());
  mass(0, 1) = mass(1, 0) =
      m.cross_couple * stance.u.dot(swing.u) + m.radius * m.swing_moment * swing.u.y();
  mass(1, 1) = m.swing_couple;
  return mass;
}

Vector2 solve(const Eigen::Matrix2d& m, const Vector2& f) {
  const double determinant = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
  return Vector2(m(1, 1) * f[0] - m(0, 1) * f[1], m(0, 0) * f[1] - m(1, 0) * f[0]) / determinant;
}

}  // namespace

StraightModel straight_model(const StraightLeggedParameters& p) {
  const double above_foot = p.hip_to_arc - p.com_below_hip;
  StraightModel m;
  m.leg = p.hip_to_arc;
  m.radius = p.foot_radius;
  m.mass = p.hip_mass + 2 * p.leg_mass;
  m.gravity_x = p.gravity * std::sin(p.slope);
  m.gravity_z = -p.gravity * std::cos(p.slope);
  m.stance_moment = (p.hip_mass + p.leg_mass) * m.leg + p.leg_mass * above_foot;
  m.swing_moment = -p.leg_mass * p.com_below_hip;
  m.stance_couple = (p.hip_mass + p.leg_mass) * m.leg * m.leg +
                    p.leg_mass * above_foot * above_foot + p.leg_inertia;
  m.cross_couple = m.leg * m.swing_moment;
  m.swing_couple = p.leg_mass * p.com_below_hip * p.com_below_hip + p.leg_inertia;
  m.transfer_leg = p.leg_inertia - p.leg_mass * p.com_below_hip * above_foot;
  m.transfer_cross = m.leg * (p.hip_mass * m.leg + 2 * p.leg_mass * above_foot);
  m.least_hip = straight_legged(p).lowest_hip;
  return m;
}

Vector2 straight_accelerations(const StraightModel& m, double stiffness, const Vector2& noise,
                               const StraightState& s) {
  const Leg stance(s.q[0]), swing(s.q[1]);
  const Vector2 square = s.qd.cwiseAbs2(), gravity(m.gravity_x, m.gravity_z);
  const double pull = m.cross_couple * stance.w.dot(swing.u);  // c01 sin(q1 - q0)
  const double hip = stiffness * (s.q[0] - s.q[1]);
  Vector2 force = noise + Vector2(m.stance_moment * gravity.dot(stance.w) - hip,
                                  m.swing_moment * gravity.dot(swing.w) + hip);
  force[0] += pull * square[1] +
              m.radius * (m.gravity_x * m.mass + m.stance_moment * stance.u.x() * square[0] +
                          m.swing_moment * swing.u.x() * square[1]);
  force[1] -= pull * square[0];
  return solve(mass_matrix(m, stance, swing), force);
}

Vector2 straight_contact_force(const StraightModel& m, const StraightState& s, const Vector2& qdd) {
  const Leg stance(s.q[0]), swing(s.q[1]);
  const Vector2 square = s.qd.cwiseAbs2();
  Vector2 force = m.stance_moment * (qdd[0] * stance.w - square[0] * stance.u) +
                  m.swing_moment * (qdd[1] * swing.w - square[1] * swing.u) -
                  m.mass * Vector2(m.gravity_x, m.gravity_z);
  force.x() += m.mass * m.radius * qdd[0];
  return force;
}

StraightTransfer straight_support_transfer(const StraightModel& m, double toe_off_impulse,
                                           const StraightState& before) {
  const Leg old_leg(before.q[0]), new_leg(before.q[1]);
  const double old_rate = before.qd[0], new_rate = before.qd[1], r = m.radius;
  const double roll = r * m.swing_moment;
  // Momenta along the coordinates for standing on the new foot, (new leg, old leg).
  const double ahead = r * (r * m.mass + m.stance_moment * (old_leg.u.y() + new_leg.u.y())) +
                       m.transfer_cross * old_leg.u.dot(new_leg.u);
  // Of the toe-off impulse.
  const double lever = m.leg * old_leg.w.dot(-new_leg.u) + r * old_leg.u.x();
  const Vector2 momentum(ahead * old_rate + (m.transfer_leg + roll * new_leg.u.y()) * new_rate +
                             toe_off_impulse * lever,
                         (m.transfer_leg + roll * old_leg.u.y()) * old_rate);
  StraightTransfer t;
  t.state.q = {before.q[1], before.q[0]};
  t.state.qd = solve(mass_matrix(m, new_leg, old_leg), momentum);
  const double centre = before.contact_x + r * before.q[0] + m.leg * (old_leg.u - new_leg.u).x();
  t.state.contact_x = centre - r * t.state.q[0];
  t.state.transfers = before.transfers + 1;
  t.step_length = m.leg * (old_leg.u - new_leg.u).x();

  const auto linear = [&](const Leg& stance, double stance_rate, const Leg& swing,
                          double swing_rate) -> Vector2 {
    return (m.stance_moment * stance.w + Vector2(r * m.mass, 0)) * stance_rate +
           m.swing_moment * swing_rate * swing.w;
  };
  const Vector2 push = toe_off_impulse * old_leg.u;
  t.impulse = linear(new_leg, t.state.qd[0], old_leg, t.state.qd[1]) -
              linear(old_leg, old_rate, new_leg, new_rate) - push;
  const Vector2 foot_before(r * old_rate, 0);
  const Vector2 foot_after =
      (m.leg * new_leg.w + Vector2(r, 0)) * t.state.qd[0] - m.leg * t.state.qd[1] * old_leg.w;
  t.toe_off_work = 0.5 * push.dot(foot_before + foot_after);
  t.old_foot_lifts = foot_after.y() >= 0;
  return t;
}

}  // namespace walker
}  // namespace walktrack
