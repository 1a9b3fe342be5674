#include "tests/mechanics/rigid_body.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/conventions.h"
#include "tests/mechanics/random_state.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;
using Eigen::VectorXd;

RigidBodyLoad no_load(double, const RigidBodyState&) { return {}; }

// Jacobi's elliptic functions by the descending Landen (AGM) scale, Abramowitz & Stegun 16.4.
struct Jacobi {
  double sn, cn, dn;
};
Jacobi jacobi(double u, double m) {
  double a[32], c[32];
  a[0] = 1;
  double b = std::sqrt(1 - m);
  c[0] = std::sqrt(m);
  int n = 0;
  while (std::abs(c[n]) > 1e-17 && n < 30) {
    a[n + 1] = (a[n] + b) / 2;
    c[n + 1] = (a[n] - b) / 2;
    b = std::sqrt(a[n] * b);
    ++n;
  }
  double phi = std::ldexp(a[n] * u, n);
  for (; n > 0; --n) phi = (std::asin(c[n] * std::sin(phi) / a[n]) + phi) / 2;
  const double sn = std::sin(phi);
  return {sn, std::cos(phi), std::sqrt(1 - m * sn * sn)};
}

const Vector3d kMoments(3, 2, 1);

RigidBody asymmetric_top() { return {1.5, kMoments.asDiagonal()}; }

RigidBodyState spinning() {
  RigidBodyState state;
  state.omega_body = Vector3d(1.2, 0, 0.7);
  return state;
}

// Torque-free asymmetric top, I1 > I2 > I3, L^2 > 2 E I2 (Landau & Lifshitz, Mechanics, section 37;
// started at omega2 = 0): omega1 = A1 dn, omega2 = A2 sn, omega3 = A3 cn.
Vector3d analytic_omega(double t) {
  const Vector3d w0 = spinning().omega_body;
  const double I1 = kMoments(0), I2 = kMoments(1), I3 = kMoments(2);
  const double E2 = (kMoments.array() * w0.array().square()).sum();
  const double M2 = (kMoments.array() * w0.array()).square().sum();
  const double A1 = std::sqrt((M2 - E2 * I3) / (I1 * (I1 - I3)));
  const double A2 = std::sqrt((E2 * I1 - M2) / (I2 * (I1 - I2)));
  const double A3 = std::sqrt((E2 * I1 - M2) / (I3 * (I1 - I3)));
  const double rate = std::sqrt((I1 - I2) * (M2 - E2 * I3) / (I1 * I2 * I3));
  const double m = (I2 - I3) * (E2 * I1 - M2) / ((I1 - I2) * (M2 - E2 * I3));
  const Jacobi j = jacobi(rate * t, m);
  // omega2' = (I3 - I1) / I2 omega3 omega1 < 0 here: sn enters with a minus sign.
  return {A1 * j.dn, -A2 * j.sn, A3 * j.cn};
}

TEST(RigidBody, TorqueFreeAsymmetricTopFollowsTheAnalyticSolution) {
  RigidBodyState state = spinning();
  const double dt = 2e-3;
  for (int i = 1; i <= 5000; ++i) {
    state = *step(asymmetric_top(), state, no_load, 0, dt, Integrator::kRk4);
    ASSERT_LT((state.omega_body - analytic_omega(i * dt)).norm(), 1e-11) << i;
  }
}

double energy_drift(Integrator integrator, double dt) {
  RigidBodyState state = spinning();
  const double start = kinetic_energy(asymmetric_top(), state);
  for (int i = 0; i < static_cast<int>(std::lround(4 / dt)); ++i) {
    state = *step(asymmetric_top(), state, no_load, 0, dt, integrator);
  }
  return std::abs(kinetic_energy(asymmetric_top(), state) - start);
}

TEST(RigidBody, EnergyDriftFallsAtTheIntegratorsOrder) {
  EXPECT_NEAR(
      std::log2(energy_drift(Integrator::kEuler, 2e-3) / energy_drift(Integrator::kEuler, 1e-3)), 1,
      0.05);
  // The quadratic invariants are at least two orders more accurate than RK4's solution.
  EXPECT_GE(std::log2(energy_drift(Integrator::kRk4, 0.08) / energy_drift(Integrator::kRk4, 0.04)),
            3.9);
  EXPECT_LT(energy_drift(Integrator::kMidpoint, 0.1), 1e-13);
}

TEST(RigidBody, MidpointConservesEnergyAndMomentumMagnitudeAtCoarseSteps) {
  RigidBodyState state = spinning();
  const double momentum = spin_angular_momentum(asymmetric_top(), state).norm();
  const double energy = kinetic_energy(asymmetric_top(), state);
  for (int i = 0; i < 2000; ++i) {
    state = *step(asymmetric_top(), state, no_load, 0, 0.1, Integrator::kMidpoint);
  }
  // 2,000 solves, each to a few rounding errors.
  EXPECT_NEAR(spin_angular_momentum(asymmetric_top(), state).norm(), momentum, 1e-11);
  EXPECT_NEAR(kinetic_energy(asymmetric_top(), state), energy, 1e-11);
}

TEST(RigidBody, AngularMomentumStaysFixedInTheWorld) {
  RigidBodyState state = spinning();
  const Vector3d start = spin_angular_momentum(asymmetric_top(), state);
  for (int i = 0; i < 2000; ++i) {
    state = *step(asymmetric_top(), state, no_load, 0, 2e-3, Integrator::kRk4);
  }
  EXPECT_LT((spin_angular_momentum(asymmetric_top(), state) - start).norm(), 1e-11);
}

// The power of a force at a point: dE/dt = f . v of that point, which determines the order of the
// factors in (x - c) x f.
TEST(RigidBody, PowerOfAForceAtAPoint) {
  Rng rng(4, Purpose::kTest);
  const RigidBody body = asymmetric_top();
  RigidBodyState state{random_vector(rng, 3), random_quaternion(rng), random_vector(rng, 3),
                       random_vector(rng, 3)};
  const Vector3d force(3, -2, 5), point(0.4, 0.1, -0.3);
  const auto load = [&](double, const RigidBodyState& s) {
    const Eigen::Matrix3d R = rotation_matrix(s.orientation);
    const Vector3d torque = torque_about(s.position, s.position + R * point, force);
    return RigidBodyLoad{force, R.transpose() * torque};
  };
  const double h = 1e-4;
  const double difference = kinetic_energy(body, *step(body, state, load, 0, h, Integrator::kRk4)) -
                            kinetic_energy(body, *step(body, state, load, 0, -h, Integrator::kRk4));
  const Vector3d velocity =
      state.velocity + rotation_matrix(state.orientation) * state.omega_body.cross(point);
  EXPECT_NEAR(difference / (2 * h), force.dot(velocity),
              1e-6);  // h^2 times derivatives of order 10
}

TEST(RigidBody, FreeFall) {
  RigidBodyState state;
  state.velocity = Vector3d(1, 2, 3);
  const auto weight = [](double, const RigidBodyState&) {
    return RigidBodyLoad{Vector3d(0, 0, -1.5 * kStandardGravity), Vector3d::Zero()};
  };
  state = *step(asymmetric_top(), state, weight, 0, 0.5, Integrator::kRk4);
  EXPECT_LT((state.position - Vector3d(0.5, 1, 1.5 - kStandardGravity / 8)).norm(), 1e-14);
}

// The lecture's quaternion equation gives the same motion as Newton-Euler.
TEST(RigidBody, QuaternionEquationAgreesWithNewtonEuler) {
  Rng rng(5, Purpose::kTest);
  for (int i = 0; i < 50; ++i) {
    const Quaternion q = random_quaternion(rng);
    const Vector3d omega = random_vector(rng, 3, 3), torque = random_vector(rng, 3, 3);
    const Vector4d q_dot = quaternion_rate(q, omega);
    const Vector3d alpha = angular_acceleration(asymmetric_top(), omega, torque);
    // q_ddot = 1/2 q_dot o (0, omega) + 1/2 q o (0, alpha)
    const Vector4d expected = quaternion_rate(q_dot, omega) + quaternion_rate(q, alpha);
    const Vector4d found = quaternion_acceleration(asymmetric_top().inertia, q, q_dot, torque, 0);
    EXPECT_LT((found - expected).norm(), 1e-12 * (1 + expected.norm()));
  }
}

// Drift of the norm when the quaternion equation is integrated by explicit Euler.
double norm_drift(double baumgarte_rate, double dt, double time) {
  Derivative derivative = [&](double, const VectorXd& y) {
    VectorXd rate(8);
    rate << y.tail<4>(), quaternion_acceleration(kMoments.asDiagonal(), y.head<4>(), y.tail<4>(),
                                                 Vector3d::Zero(), baumgarte_rate);
    return rate;
  };
  VectorXd y(8);
  y << identity_quaternion(), quaternion_rate(identity_quaternion(), spinning().omega_body);
  for (int i = 0; i < static_cast<int>(std::lround(time / dt)); ++i) {
    y = *integrate_step(Integrator::kEuler, derivative, 0, dt, y);
  }
  return std::abs(y.head<4>().norm() - 1);
}

TEST(RigidBody, UnitQuaternionDriftsWithoutStabilisationAndIsHeldByBaumgarte) {
  const double at_2 = norm_drift(0, 1e-3, 2), at_8 = norm_drift(0, 1e-3, 8);
  EXPECT_GT(at_8, 3 * at_2);  // grows with time
  EXPECT_GT(at_8, 1e-3);
  EXPECT_LT(norm_drift(20, 1e-3, 8), at_8 / 20);
  EXPECT_NEAR(norm_drift(0, 1e-3, 2) / norm_drift(0, 5e-4, 2), 2, 0.2);  // Euler's first order
}

}  // namespace
}  // namespace walktrack
