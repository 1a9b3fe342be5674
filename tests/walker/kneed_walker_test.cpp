#include "walker/kneed/kneed_walker.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "core/rng.h"
#include "tests/walker/kneed_files.h"

namespace walktrack {
namespace {

double relative_error(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  return (found - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

// A walker's parts computed link by link, independent of the kernel's closed form. Positions of the
// centres of mass and of the joints.
struct Chain {
  std::array<Vector2, 5> centre;
  Vector2 stance_knee, hip, swing_knee, swing_contact;
};

Vector2 up(double angle) { return {std::sin(angle), std::cos(angle)}; }
Vector2 ahead(double angle) { return {std::cos(angle), -std::sin(angle)}; }

Chain chain(const KneedParameters& p, const Vector5& q, double contact_x = 0) {
  Chain c;
  const Vector2 arc(contact_x + p.foot_radius * q[3], p.foot_radius);
  const Vector2 ankle = arc - p.foot_up * up(q[3]) - p.foot_forward * ahead(q[3]);
  c.stance_knee = ankle + p.shank_length * up(q[3]);
  c.hip = c.stance_knee + p.thigh_length * up(q[1]);
  c.swing_knee = c.hip - p.thigh_length * up(q[2]);
  const Vector2 swing_ankle = c.swing_knee - p.shank_length * up(q[4]);
  c.swing_contact =
      swing_ankle + p.foot_up * up(q[4]) + p.foot_forward * ahead(q[4]) - Vector2(0, p.foot_radius);
  const auto shank_centre = [&](const Vector2& a, double angle) -> Vector2 {
    return a + p.shank.com_above_ankle * up(angle) + p.shank.com_forward * ahead(angle);
  };
  c.centre = {c.hip + p.torso.com_above_hip * up(q[0]), c.hip - p.thigh.com_below_hip * up(q[1]),
              c.hip - p.thigh.com_below_hip * up(q[2]), shank_centre(ankle, q[3]),
              shank_centre(swing_ankle, q[4])};
  return c;
}

std::array<double, 5> masses(const KneedParameters& p) {
  return {p.torso.mass, p.thigh.mass, p.thigh.mass, p.shank.mass, p.shank.mass};
}
std::array<double, 5> inertias(const KneedParameters& p) {
  return {p.torso.inertia, p.thigh.inertia, p.thigh.inertia, p.shank.inertia, p.shank.inertia};
}

// Velocities of the centres by central differences (exact to about 1e-10).
std::array<Vector2, 5> centre_velocities(const KneedParameters& p, const Vector5& q,
                                         const Vector5& qd) {
  constexpr double kDt = 1e-5;
  const Chain later = chain(p, q + kDt * qd), earlier = chain(p, q - kDt * qd);
  std::array<Vector2, 5> v;
  for (size_t i = 0; i < 5; ++i) v[i] = (later.centre[i] - earlier.centre[i]) / (2 * kDt);
  return v;
}

Vector2 momentum(const KneedParameters& p, const Vector5& q, const Vector5& qd) {
  const auto v = centre_velocities(p, q, qd);
  Vector2 sum = Vector2::Zero();
  for (size_t i = 0; i < 5; ++i) sum += masses(p)[i] * v[i];
  return sum;
}

// Angular momentum of some parts about a point that is at rest, positive forward.
double spin(const KneedParameters& p, const Vector5& q, const Vector5& qd,
            const std::vector<size_t>& parts, const Vector2& about) {
  const Chain c = chain(p, q);
  const auto v = centre_velocities(p, q, qd);
  double sum = 0;
  for (const size_t i : parts) {
    const Vector2 r = c.centre[i] - about;
    sum +=
        masses(p)[i] * (r.y() * v[i].x() - r.x() * v[i].y()) + inertias(p)[i] * qd[Eigen::Index(i)];
  }
  return sum;
}

class KneedReference : public testing::Test {
 protected:
  ReferenceFile file = read_kneed_reference();
  KneedModel model = kneed_model(file.parameters);
};

TEST_F(KneedReference, MassMatrix) {
  // The file has 12 digits; the requirement is 1e-9 relative, here and below.
  for (const auto& r : file.states)
    EXPECT_LT(relative_error(kneed_mass_matrix(model, r.state.q), r.mass_matrix), 1e-9);
}

TEST_F(KneedReference, AccelerationsWithAndWithoutStops) {
  int limited = 0;
  for (const auto& r : file.states) {
    KneedState free = r.state;
    free.stance_stop = free.swing_stop = false;
    const auto a = kneed_accelerations(model, file.controls, Vector5::Zero(), free);
    EXPECT_LT(relative_error(a.qdd, r.qdd_free), 1e-9);
    if (!r.qdd_limited) continue;
    ++limited;
    const auto held = kneed_accelerations(model, file.controls, Vector5::Zero(), r.state);
    EXPECT_LT(relative_error(held.qdd, *r.qdd_limited), 1e-9);
    EXPECT_LT(relative_error(Vector2(held.stop_torque[0], held.stop_torque[1]), r.limit_torque),
              1e-9);
  }
  EXPECT_EQ(limited, 2);
}

TEST_F(KneedReference, Energy) {
  for (const auto& r : file.states) {
    const KneedEnergy e = kneed_energy(model, r.state);
    EXPECT_NEAR((e.kinetic + e.potential) / r.energy, 1, 1e-9);
  }
}

TEST_F(KneedReference, SupportTransfer) {
  for (const auto& r : file.states) {
    const KneedState passive = kneed_support_transfer(model, 0, r.state).state;
    EXPECT_EQ(passive.q, r.strike_impulse_0.q);
    EXPECT_LT(relative_error(passive.qd, r.strike_impulse_0.qd), 1e-9);
    const KneedState pushed = kneed_support_transfer(model, 20, r.state).state;
    EXPECT_LT(relative_error(pushed.qd, r.strike_impulse_20.qd), 1e-9);
  }
}

TEST_F(KneedReference, PostureFollowsTheChainAndContinuesThroughATransfer) {
  for (const auto& r : file.states) {
    KneedState before = r.state;
    before.contact_x = 3.25;
    const Chain c = chain(file.parameters, before.q, before.contact_x);
    const KneedPosture a = kneed_posture(model, before);
    EXPECT_LT((a.hip - c.hip).norm() + (a.swing_knee - c.swing_knee).norm() +
                  (a.stance_knee - c.stance_knee).norm() + (a.torso_com - c.centre[0]).norm(),
              1e-13);
    const KneedState after = kneed_support_transfer(model, 0, before).state;
    const KneedPosture b = kneed_posture(model, after);
    // These states are not on the ground, so that only the horizontal contact is continuous.
    EXPECT_NEAR(a.swing_foot.x(), b.stance_foot.x(), 1e-13);
    EXPECT_NEAR(a.hip.x(), b.hip.x(), 1e-13);
    EXPECT_NEAR(a.stance_foot.x(), b.swing_foot.x(), 1e-13);
    const SwingFoot foot = kneed_swing_foot(model, before);
    EXPECT_NEAR(foot.height, c.swing_contact.y(), 1e-13);
    EXPECT_NEAR(foot.lead, a.swing_foot.x() - a.stance_foot.x(), 1e-13);
  }
}

// Random postures of an upright walker; every draw has another build as well.
struct Sample {
  KneedParameters parameters;
  KneedControls controls;
  KneedState state;
};

Sample random_sample(const ReferenceFile& file, uint32_t index) {
  Rng rng(7, Purpose::kTest, 0, index);
  const auto scale = [&] { return 0.5 + rng.uniform(); };
  Sample s{file.parameters, file.controls, {}};
  s.parameters.slope = 0.4 * (rng.uniform() - 0.5);
  s.parameters.thigh_length *= scale();
  s.parameters.foot_radius *= scale();
  s.parameters.shank.mass *= scale();
  s.parameters.torso.inertia *= scale();
  s.controls.hip.stiffness *= scale();
  for (int k = 0; k < 5; ++k) {
    s.state.q[k] = 0.5 * rng.normal();
    s.state.qd[k] = 2 * rng.normal();
  }
  return s;
}

TEST_F(KneedReference, MassMatrixIsPositiveAndGivesTheKineticEnergyOfTheParts) {
  for (uint32_t n = 0; n < 100; ++n) {
    const Sample s = random_sample(file, n);
    const Matrix5 mass = kneed_mass_matrix(kneed_model(s.parameters), s.state.q);
    EXPECT_EQ(mass, mass.transpose());
    EXPECT_EQ(Eigen::LLT<Matrix5>(mass).info(), Eigen::Success);
    double kinetic = 0;
    const auto v = centre_velocities(s.parameters, s.state.q, s.state.qd);
    for (size_t i = 0; i < 5; ++i) {
      const double rate = s.state.qd[Eigen::Index(i)];
      kinetic += 0.5 * masses(s.parameters)[i] * v[i].squaredNorm() +
                 0.5 * inertias(s.parameters)[i] * rate * rate;
    }
    // Differences of step 1e-5: 1e-10 of truncation, 1e-11 of rounding.
    EXPECT_NEAR(0.5 * s.state.qd.dot(mass * s.state.qd) / kinetic, 1, 1e-8);
  }
}

TEST_F(KneedReference, EnergyChangesByThePowerOfTheTorques) {
  constexpr double kDt = 1e-5;
  for (uint32_t n = 0; n < 100; ++n) {
    const Sample s = random_sample(file, n);
    const KneedModel m = kneed_model(s.parameters);
    const Vector5 noise(1, -2, 0.5, 3, -1);
    const Vector5 qdd = kneed_accelerations(m, s.controls, noise, s.state).qdd;
    const auto energy_at = [&](double t) {
      KneedState moved = s.state;
      moved.q += t * s.state.qd + 0.5 * t * t * qdd;
      moved.qd += t * qdd;
      const KneedEnergy e = kneed_energy(m, moved);
      return e.kinetic + e.potential;
    };
    const double rate = (energy_at(kDt) - energy_at(-kDt)) / (2 * kDt);
    const Vector5 torque = kneed_torques(s.controls, s.state.q, s.state.qd) + noise;
    EXPECT_NEAR(rate, torque.dot(s.state.qd), 1e-5 * (1 + torque.norm() * s.state.qd.norm()));
  }
}

TEST_F(KneedReference, SpringsOfHipAndKneesHaveAPotentialAndDampersOnlyTake) {
  for (uint32_t n = 0; n < 50; ++n) {
    const Sample s = random_sample(file, n);
    KneedControls springs = s.controls;
    springs.torso = {};
    for (SpringDamper* joint : {&springs.hip, &springs.stance_knee, &springs.swing_knee})
      joint->damping = 0;
    const auto potential = [&](const Vector5& q) {
      const auto stored = [](const SpringDamper& j, double angle) {
        return 0.5 * j.stiffness * (angle - j.rest) * (angle - j.rest);
      };
      return stored(springs.hip, q[1] - q[2]) + stored(springs.stance_knee, q[3] - q[1]) +
             stored(springs.swing_knee, q[4] - q[2]);
    };
    const Vector5 torque = kneed_torques(springs, s.state.q, s.state.qd);
    for (int k = 0; k < 5; ++k) {
      const Vector5 step = 1e-6 * Vector5::Unit(k);
      const double slope = (potential(s.state.q + step) - potential(s.state.q - step)) / 2e-6;
      EXPECT_NEAR(torque[k], -slope, 1e-6);
    }
    KneedControls damped = s.controls;
    damped.torso = {};
    const Vector5 damping = kneed_torques(damped, s.state.q, s.state.qd) -
                            kneed_torques(damped, s.state.q, Vector5::Zero());
    EXPECT_LE(damping.dot(s.state.qd), 0);
  }
}

TEST_F(KneedReference, ContactForceIsTheRateOfMomentum) {
  constexpr double kDt = 2e-5;
  for (uint32_t n = 0; n < 50; ++n) {
    const Sample s = random_sample(file, n);
    const KneedModel m = kneed_model(s.parameters);
    const Vector5 qdd = kneed_accelerations(m, s.controls, Vector5::Zero(), s.state).qdd;
    const auto momentum_at = [&](double t) {
      return momentum(s.parameters, s.state.q + t * s.state.qd + 0.5 * t * t * qdd,
                      s.state.qd + t * qdd);
    };
    const Vector2 rate = (momentum_at(kDt) - momentum_at(-kDt)) / (2 * kDt);
    const Vector2 force = kneed_contact_force(m, s.state, qdd) + m.total_mass * m.gravity;
    // Nested differences lose half of the digits.
    EXPECT_LT((rate - force).norm(), 1e-4 * (1 + force.norm()));
  }
}

// The walker's points do not move during a strike, so that the angular momenta of every chain of
// parts about the joint that carries it are conserved. Parts are in the order before the strike.
TEST_F(KneedReference, TransferConservesSpinAboutContactAndJoints) {
  for (uint32_t n = 0; n < 50; ++n) {
    const Sample s = random_sample(file, n);
    const KneedParameters& p = s.parameters;
    const KneedModel m = kneed_model(p);
    const KneedState after = kneed_support_transfer(m, 0, s.state).state;
    const Chain c = chain(p, s.state.q), d = chain(p, after.q);
    const auto expect_kept = [&](const std::vector<size_t>& parts, const Vector2& about,
                                 const std::vector<size_t>& parts_after,
                                 const Vector2& about_after) {
      const double a = spin(p, s.state.q, s.state.qd, parts, about);
      const double b = spin(p, after.q, after.qd, parts_after, about_after);
      EXPECT_NEAR(a, b, 1e-7 * (1 + std::abs(a)));
    };
    const Vector2 contact_after(p.foot_radius * after.q[3], 0);
    expect_kept({0, 1, 2, 3, 4}, c.swing_contact, {0, 1, 2, 3, 4}, contact_after);
    expect_kept({0, 1, 2, 3}, c.swing_knee, {0, 1, 2, 4}, d.stance_knee);
    expect_kept({0}, c.hip, {0}, d.hip);
    expect_kept({1, 3}, c.hip, {2, 4}, d.hip);
    expect_kept({3}, c.stance_knee, {4}, d.swing_knee);
  }
}

TEST_F(KneedReference, TransferWithoutImpulseTakesEnergyAndReportsTheImpulse) {
  for (uint32_t n = 0; n < 50; ++n) {
    const Sample s = random_sample(file, n);
    const KneedModel m = kneed_model(s.parameters);
    const KneedTransfer t = kneed_support_transfer(m, 0, s.state);
    EXPECT_LE(kneed_energy(m, t.state).kinetic, kneed_energy(m, s.state).kinetic * (1 + 1e-12));
    const Vector2 change = momentum(s.parameters, t.state.q, t.state.qd) -
                           momentum(s.parameters, s.state.q, s.state.qd);
    EXPECT_LT((t.impulse - change).norm(), 1e-6 * (1 + change.norm()));
  }
}

}  // namespace
}  // namespace walktrack
