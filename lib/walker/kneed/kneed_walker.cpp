// Derivation. With c_k = cos q_k, s_k = sin q_k, C_jk = cos(q_k - q_j), S_jk = sin(q_k - q_j) and
// the model's sums A = couple, B = skew, a = along_moment, b = across_moment:
//   M_jk      = A_jk C_jk - B_jk S_jk + R (terms of the rolling contact in row and column 3)
//   M_jj      = A_jj,  x_k = a_k c_k - b_k s_k,  z_k = -a_k s_k - b_k c_k  (first moments' rates)
//   M_j3     += R x_j,  M_33 += R^2 m + 2 R x_3
//   force_j   = sum_k (A_jk S_jk + B_jk C_jk) qd_k^2 + g_x x_j + g_z z_j
//   force_3  += R (sum_k (a_k s_k + b_k c_k) qd_k^2 + g_x m)
#include "walker/kneed/kneed_walker.h"

#include "walker/kneed/kneed_points.h"

namespace walktrack {
inline namespace walker {
namespace {

struct Dynamics {
  Matrix5 mass;
  Vector5 force;  // gravity minus Coriolis
};

// Rates of the first moments: (sum_i m_i dp_i/dq_k) without the part of the rolling contact.
struct MomentRates {
  Vector5 x, z;
};

MomentRates moment_rates(const KneedModel& model, const KneedTrig& t) {
  const Vector5 &a = model.along_moment, &b = model.across_moment;
  return {a.cwiseProduct(t.cosine) - b.cwiseProduct(t.sine),
          -a.cwiseProduct(t.sine) - b.cwiseProduct(t.cosine)};
}

Dynamics dynamics(const KneedModel& model, const Vector5& q, const Vector5& qd) {
  const KneedTrig t(q);
  const MomentRates rates = moment_rates(model, t);
  const Vector5 qd2 = qd.cwiseProduct(qd);
  Dynamics d;
  d.force = model.gravity.x() * rates.x + model.gravity.y() * rates.z;
  for (int j = 0; j < 5; ++j) {
    d.mass(j, j) = model.couple(j, j);
    for (int k = j + 1; k < 5; ++k) {
      const double cosine = t.cosine[j] * t.cosine[k] + t.sine[j] * t.sine[k];
      const double sine = t.sine[k] * t.cosine[j] - t.cosine[k] * t.sine[j];
      d.mass(k, j) = model.couple(j, k) * cosine - model.skew(j, k) * sine;
      const double pull = model.couple(j, k) * sine + model.skew(j, k) * cosine;
      d.force[j] += pull * qd2[k];
      d.force[k] -= pull * qd2[j];
    }
  }
  const double radius = model.parameters.foot_radius;
  for (int k = 0; k < kStanceShank; ++k) d.mass(kStanceShank, k) += radius * rates.x[k];
  d.mass(kSwingShank, kStanceShank) += radius * rates.x[kSwingShank];
  d.mass(kStanceShank, kStanceShank) +=
      radius * (radius * model.total_mass + 2 * rates.x[kStanceShank]);
  const Vector5 sway = model.along_moment.cwiseProduct(t.sine) +
                       model.across_moment.cwiseProduct(t.cosine);  // -d(rates.x)/dq
  d.force[kStanceShank] += radius * (model.gravity.x() * model.total_mass + sway.dot(qd2));
  return d;
}

// Flexion of a knee is q[shank] - q[thigh].
constexpr std::array<KneedAngle, 2> kThighOf{kStanceThigh, kSwingThigh};
constexpr std::array<KneedAngle, 2> kShankOf{kStanceShank, kSwingShank};

double flexion(const Vector5& v, int knee) { return v[kShankOf[knee]] - v[kThighOf[knee]]; }

Vector5 stop_direction(int knee) {
  Vector5 row = Vector5::Zero();
  row[kShankOf[knee]] = 1;
  row[kThighOf[knee]] = -1;
  return row;
}

}  // namespace

KneedModel kneed_model(const KneedParameters& p) {
  KneedModel model{.parameters = p};
  model.gravity = p.gravity * Vector2(std::sin(p.slope), -std::cos(p.slope));
  const auto centres = part_centres(p);
  const auto masses = part_masses(p);
  for (size_t i = 0; i < 5; ++i) {
    const Vector5 &a = centres[i].along, &b = centres[i].across;
    model.total_mass += masses[i];
    model.along_moment += masses[i] * a;
    model.across_moment += masses[i] * b;
    model.couple += masses[i] * (a * a.transpose() + b * b.transpose());
    model.skew += masses[i] * (a * b.transpose() - b * a.transpose());
    model.couple(Eigen::Index(i), Eigen::Index(i)) += part_inertias(p)[i];
  }
  return model;
}

double standing_hip_height(const KneedParameters& p) {
  return p.foot_radius - p.foot_up + p.shank_length + p.thigh_length;
}

Matrix5 kneed_mass_matrix(const KneedModel& model, const Vector5& q) {
  return dynamics(model, q, Vector5::Zero()).mass.selfadjointView<Eigen::Lower>();
}

Vector5 kneed_torques(const KneedControls& c, const Vector5& q, const Vector5& qd) {
  const auto resisting = [](const SpringDamper& s, double angle, double rate) {
    return s.stiffness * (s.rest - angle) - s.damping * rate;
  };
  const double torso = resisting(c.torso, q[kTorso], qd[kTorso]);
  const double hip =
      -resisting(c.hip, q[kStanceThigh] - q[kSwingThigh], qd[kStanceThigh] - qd[kSwingThigh]);
  const double stance_knee = resisting(c.stance_knee, flexion(q, 0), flexion(qd, 0));
  const double swing_knee = resisting(c.swing_knee, flexion(q, 1), flexion(qd, 1));
  return {torso, -torso - hip - stance_knee, hip - swing_knee, stance_knee, swing_knee};
}

KneedAcceleration kneed_accelerations(const KneedModel& model, const KneedControls& controls,
                                      const Vector5& noise, const KneedState& state) {
  Dynamics d = dynamics(model, state.q, state.qd);
  factorise(d.mass);
  const Vector5 force = d.force + kneed_torques(controls, state.q, state.qd) + noise;
  KneedAcceleration result{.qdd = solve_factorised(d.mass, force)};
  const std::array<bool, 2> held{state.stance_stop, state.swing_stop};
  if (!held[0] && !held[1]) return result;

  // [M -a; a' 0] [qdd; torque] = [force; 0]: torque = -(a' M^-1 a)^-1 a' qdd_free, stacked rows.
  std::array<Vector5, 2> response;
  for (int k = 0; k < 2; ++k) response[k] = solve_factorised(d.mass, stop_direction(k));
  if (held[0] && held[1]) {
    const double a = flexion(response[0], 0), b = flexion(response[0], 1);
    const double c = flexion(response[1], 1), determinant = a * c - b * b;
    const double first = -flexion(result.qdd, 0), second = -flexion(result.qdd, 1);
    result.stop_torque = {(c * first - b * second) / determinant,
                          (a * second - b * first) / determinant};
  } else {
    const int knee = held[0] ? 0 : 1;
    result.stop_torque[knee] = -flexion(result.qdd, knee) / flexion(response[knee], knee);
  }
  for (int k = 0; k < 2; ++k) result.qdd += result.stop_torque[k] * response[k];
  return result;
}

KneedEnergy kneed_energy(const KneedModel& model, const KneedState& state) {
  const KneedParameters& p = model.parameters;
  const KneedTrig t(state.q);
  const Vector2 base(state.contact_x + p.foot_radius * state.q[kStanceShank], p.foot_radius);
  const Vector2 moment(model.along_moment.dot(t.sine) + model.across_moment.dot(t.cosine),
                       model.along_moment.dot(t.cosine) - model.across_moment.dot(t.sine));
  return {.kinetic = 0.5 * state.qd.dot(kneed_mass_matrix(model, state.q) * state.qd),
          .potential = -model.gravity.dot(model.total_mass * base + moment)};
}

Vector2 kneed_contact_force(const KneedModel& model, const KneedState& state, const Vector5& qdd) {
  const KneedTrig t(state.q);
  const MomentRates rates = moment_rates(model, t);
  const Vector5 qd2 = state.qd.cwiseProduct(state.qd);
  const Vector5 sway =
      model.along_moment.cwiseProduct(t.sine) + model.across_moment.cwiseProduct(t.cosine);
  const Vector2 momentum_rate(
      rates.x.dot(qdd) - sway.dot(qd2) +
          model.parameters.foot_radius * model.total_mass * qdd[kStanceShank],
      rates.z.dot(qdd) - rates.x.dot(qd2));
  return momentum_rate - model.total_mass * model.gravity;
}

namespace {

Vector5 relabelled(const Vector5& v) { return {v[0], v[2], v[1], v[4], v[3]}; }

struct Momentum {
  Vector5 on_new_stance;            // sum_i m_i dp_i/dq_j(new)' v_i + I_j qd_j
  Vector2 total = Vector2::Zero();  // sum_i m_i v_i, N s
};

Momentum transferred_momentum(const KneedParameters& p, const KneedState& before,
                              const KneedTrig& before_trig, const KneedTrig& after_trig) {
  constexpr std::array<size_t, 5> kOldLabel{0, 2, 1, 4, 3};
  const auto centres = part_centres(p);
  const auto masses = part_masses(p);
  const auto inertias = part_inertias(p);
  Momentum momentum{relabelled(before.qd)};
  for (int i = 0; i < 5; ++i) momentum.on_new_stance[i] *= inertias[size_t(i)];
  for (size_t i = 0; i < 5; ++i) {
    const Vector2 part_momentum =
        masses[i] * point_jacobian(centres[kOldLabel[i]], before_trig, p.foot_radius) * before.qd;
    momentum.total += part_momentum;
    momentum.on_new_stance +=
        point_jacobian(centres[i], after_trig, p.foot_radius).transpose() * part_momentum;
  }
  return momentum;
}

}  // namespace

KneedTransfer kneed_support_transfer(const KneedModel& model, double toe_off_impulse,
                                     const KneedState& before) {
  const KneedParameters& p = model.parameters;
  const KneedTrig before_trig(before.q);
  KneedTransfer result{.state = before, .impulse = Vector2::Zero()};
  KneedState& after = result.state;
  after.q = relabelled(before.q);
  std::swap(after.stance_stop, after.swing_stop);
  after.contact_x = point_position(swing_foot_point(p), before_trig, p, before).x() -
                    p.foot_radius * after.q[kStanceShank];
  const KneedTrig after_trig(after.q);
  const Momentum momentum = transferred_momentum(p, before, before_trig, after_trig);

  const Vector2 hip = point_position(hip_point(p), before_trig, p, before);
  const Vector2 old_foot = point_position(KneedPoint{}, before_trig, p, before);
  const Vector2 toe_off = toe_off_impulse * (hip - old_foot).normalized();
  const PointJacobian at_old_foot = point_jacobian(swing_foot_point(p), after_trig, p.foot_radius);

  Matrix5 factor = dynamics(model, after.q, Vector5::Zero()).mass;
  factorise(factor);
  after.qd = solve_factorised(factor, momentum.on_new_stance + at_old_foot.transpose() * toe_off);
  const MomentRates rates = moment_rates(model, after_trig);
  const Vector2 total_after(
      rates.x.dot(after.qd) + p.foot_radius * model.total_mass * after.qd[kStanceShank],
      rates.z.dot(after.qd));
  result.impulse = total_after - momentum.total - toe_off;
  after.since_transfer = 0;
  after.clearance = KneedState{}.clearance;
  ++after.transfers;
  return result;
}

}  // namespace walker
}  // namespace walktrack
