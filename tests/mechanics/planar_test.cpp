#include "mechanics/planar.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "tests/mechanics/random_state.h"

namespace walktrack {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

struct DoublePendulum {
  double m1 = 2, m2 = 0.7, l1 = 1.1, l2 = 0.6, i1 = 0.05, i2 = 0.02;  // kg, m, kg m^2

  std::vector<PlanarPart> parts() const {
    const PlanarPoint first = bar(2, 0, l1);
    return {{m1, i1, first, 0}, {m2, i2, first + bar(2, 1, l2), 1}};
  }
};

const Vector2d kDown(0, -kStandardGravity);

// Hand-derived (Lagrange), angles from the upward vertical:
//   (m1 + m2) l1^2 + i1,  m2 l1 l2 cos(a1 - a2);  m2 l2^2 + i2
TEST(Planar, GeneralAssemblyEqualsTheHandDerivedDoublePendulum) {
  const DoublePendulum p;
  Rng rng(1, Purpose::kTest);
  for (int i = 0; i < 100; ++i) {
    const VectorXd q = random_vector(rng, 2, 3), qd = random_vector(rng, 2, 5);
    const double c = std::cos(q(0) - q(1)), s = std::sin(q(0) - q(1)), g = kStandardGravity;
    const double couple = p.m2 * p.l1 * p.l2;
    Eigen::Matrix2d mass;
    mass << (p.m1 + p.m2) * p.l1 * p.l1 + p.i1, couple * c, couple * c, p.m2 * p.l2 * p.l2 + p.i2;
    const Vector2d force(-couple * s * qd(1) * qd(1) + (p.m1 + p.m2) * g * p.l1 * std::sin(q(0)),
                         couple * s * qd(0) * qd(0) + p.m2 * g * p.l2 * std::sin(q(1)));
    const TmtSystem system = assemble(p.parts(), kDown, q, qd);
    EXPECT_LT((system.mass - mass).norm(), 1e-12 * mass.norm());
    EXPECT_LT((system.force - force).norm(), 1e-12 * (1 + force.norm()));
  }
}

// A point with every kind of term.
PlanarPoint general_point() {
  PlanarPoint point = bar(3, 0, 0.4, -0.1) + bar(3, 1, 0.3, 0.2);
  point.constant << 0.5, 0.25;
  point.linear.col(0) << 0.3, 0;
  point.linear.col(2) << 0, 1;
  return point;
}

TEST(Planar, JacobianAndConvectiveTermAreDerivatives) {
  Rng rng(2, Purpose::kTest);
  const PlanarPoint point = general_point();
  const VectorXd q = random_vector(rng, 3), qd = random_vector(rng, 3);
  const double h = 1e-5;  // central differences: h^2 / 6 plus 1e-16 / h
  const Vector2d velocity = (position(point, q + h * qd) - position(point, q - h * qd)) / (2 * h);
  EXPECT_LT((jacobian(point, q) * qd - velocity).norm(), 1e-10);
  const Vector2d acceleration =
      (jacobian(point, q + h * qd) * qd - jacobian(point, q - h * qd) * qd) / (2 * h);
  EXPECT_LT((convective(point, q, qd) - acceleration).norm(), 1e-10);
}

TEST(Planar, DirectionsFollowTheConventions) {
  const VectorXd lean = VectorXd::Constant(1, 0.1);  // positive leans the upper end forward (+x)
  EXPECT_GT(position(bar(1, 0, 1), lean).x(), 0);
  EXPECT_LT(position(bar(1, 0, 0, 1), lean).y(), 0);  // and lowers what is in front
  EXPECT_LT((position(bar(1, 0, 2, 3) - bar(1, 0, 2, 3), lean)).norm(), 1e-15);
}

TEST(Planar, EnergyIsThatOfTheMassMatrixAndItsRateIsThePower) {
  const DoublePendulum p;
  Rng rng(3, Purpose::kTest);
  for (int i = 0; i < 20; ++i) {
    const VectorXd q = random_vector(rng, 2, 3), qd = random_vector(rng, 2, 5);
    const VectorXd torque = random_vector(rng, 2, 10);
    const TmtSystem system = assemble(p.parts(), kDown, q, qd);
    const PlanarEnergy energy = mechanical_energy(p.parts(), kDown, q, qd);
    EXPECT_NEAR(energy.kinetic, 0.5 * qd.dot(system.mass * qd), 1e-12 * energy.kinetic);
    const VectorXd qdd = solve_mass(system.mass, system.force + torque);
    const double h = 1e-5;
    const auto total = [&](double t) {
      const PlanarEnergy e =
          mechanical_energy(p.parts(), kDown, q + t * qd + t * t / 2 * qdd, qd + t * qdd);
      return e.kinetic + e.potential;
    };
    // h^2 times third derivatives of order 1e4
    EXPECT_NEAR((total(h) - total(-h)) / (2 * h), torque.dot(qd), 2e-6);
  }
}

TEST(Planar, MomentumIsTheIndependentSumAndForceItsRate) {
  const DoublePendulum p;
  Rng rng(4, Purpose::kTest);
  const VectorXd q = random_vector(rng, 2), qd = random_vector(rng, 2), qdd = random_vector(rng, 2);
  const PlanarMomentum now = momentum(p.parts(), q, qd);
  EXPECT_NEAR(now.mass, p.m1 + p.m2, 1e-15);
  const double h = 1e-5;
  const auto at = [&](double t) {
    return momentum(p.parts(), q + t * qd + t * t / 2 * qdd, qd + t * qdd);
  };
  const Vector2d velocity = (at(h).com - at(-h).com) / (2 * h);
  EXPECT_LT((now.linear / now.mass - velocity).norm(), 1e-9);
  const Vector2d rate = (at(h).linear - at(-h).linear) / (2 * h);
  EXPECT_LT((outer_force(p.parts(), Vector2d::Zero(), q, qd, qdd) - rate).norm(), 1e-8);
  EXPECT_LT((outer_force(p.parts(), kDown, q, qd, qdd) - rate + now.mass * kDown).norm(), 1e-8);
  // One rigid bar turning forward about its own centre: L = I omega > 0.
  const std::vector<PlanarPart> spinning{{2, 0.3, PlanarPoint(1), 0}};
  EXPECT_NEAR(momentum(spinning, VectorXd::Zero(1), VectorXd::Constant(1, 4)).angular, 1.2, 1e-15);
}

TEST(Planar, GradedMassesKeepTheirDigits) {
  // A swinging leg of 1e-10 of the body's mass: its equation must not be lost in the rounding of
  // the other one.
  const DoublePendulum light{1, 1e-10, 1, 1, 0, 0};
  const VectorXd q = Vector2d(0.2, 0.5), qd = Vector2d(0.3, -0.4);
  const TmtSystem system = assemble(light.parts(), kDown, q, qd);
  const VectorXd qdd = solve_mass(system.mass, system.force);
  const double c = std::cos(q(0) - q(1)), s = std::sin(q(0) - q(1)), g = kStandardGravity;
  const double first = g * std::sin(q(0));  // the limit of no mass at the end
  EXPECT_NEAR(qdd(0), first, 1e-8);
  EXPECT_NEAR(qdd(1), -c * first + s * qd(0) * qd(0) + g * std::sin(q(1)), 1e-8);
}

}  // namespace
}  // namespace walktrack
