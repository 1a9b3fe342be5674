#include "mechanics/constraints.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/conventions.h"
#include "mechanics/integrator.h"
#include "tests/mechanics/random_state.h"

namespace walktrack {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// The lecture's bead on the unit sphere: e = (|x|^2 - 1) / 2.
Constraint sphere(const Vector3d& x, const Vector3d& v) {
  return {VectorXd::Constant(1, (x.squaredNorm() - 1) / 2), x.transpose(),
          VectorXd::Constant(1, v.squaredNorm())};
}

struct Bead {
  Vector3d x{1, 0, 0}, v{0, 2, 0.5};
  double energy() const { return 0.5 * v.squaredNorm() + kStandardGravity * x.z(); }
};

Bead slid(Stabilisation stabilisation, Integrator integrator, double dt, double time,
          double rate = 20) {
  const MatrixXd mass = MatrixXd::Identity(3, 3);
  const Derivative derivative = [&](double, const VectorXd& y) {
    VectorXd y_dot(6);
    const double r = stabilisation == Stabilisation::kBaumgarte ? rate : 0;
    y_dot << y.tail<3>(), solve_augmented(mass, Vector3d(0, 0, -kStandardGravity),
                                          sphere(y.head<3>(), y.tail<3>()), y.tail<3>(), r)
                              .acceleration;
    return y_dot;
  };
  Bead bead;
  for (int i = 0; i < static_cast<int>(std::lround(time / dt)); ++i) {
    VectorXd y(6);
    y << bead.x, bead.v;
    y = *integrate_step(integrator, derivative, 0, dt, y);
    bead = {y.head<3>(), y.tail<3>()};
    if (stabilisation != Stabilisation::kProjection) continue;
    for (int k = 0; k < 3; ++k) bead.x += position_correction(mass, sphere(bead.x, bead.v));
    bead.v = projected_velocity(mass, sphere(bead.x, bead.v), bead.v);
  }
  return bead;
}

double drift(const Bead& bead) { return std::abs(bead.x.norm() - 1); }

TEST(Constraints, BeadDriftsFreelyWithoutStabilisation) {
  const double at_1 = drift(slid(Stabilisation::kNone, Integrator::kEuler, 1e-3, 1));
  const double at_4 = drift(slid(Stabilisation::kNone, Integrator::kEuler, 1e-3, 4));
  EXPECT_GT(at_1, 1e-3);
  EXPECT_GT(at_4, 3 * at_1);
  // RK4 drifts as well, with its order: halving the step divides the drift by at least 2^4.
  const double coarse = drift(slid(Stabilisation::kNone, Integrator::kRk4, 2e-2, 4));
  const double fine = drift(slid(Stabilisation::kNone, Integrator::kRk4, 1e-2, 4));
  EXPECT_GT(coarse, 1e-7);
  EXPECT_GT(std::log2(coarse / fine), 3.8);
}

TEST(Constraints, BaumgarteBoundsTheDriftAndProjectionRemovesIt) {
  const double free = drift(slid(Stabilisation::kNone, Integrator::kEuler, 1e-3, 4));
  const double held = drift(slid(Stabilisation::kBaumgarte, Integrator::kEuler, 1e-3, 4));
  EXPECT_LT(held, free / 20);
  const Bead projected = slid(Stabilisation::kProjection, Integrator::kEuler, 1e-3, 4);
  EXPECT_LT(drift(projected), 1e-14);
  EXPECT_LT(std::abs(projected.x.dot(projected.v)), 1e-14);
}

TEST(Constraints, ProjectedRk4KeepsTheBeadsEnergy) {
  const Bead bead = slid(Stabilisation::kProjection, Integrator::kRk4, 1e-3, 4);
  EXPECT_NEAR(bead.energy(), Bead().energy(), 1e-9);  // order 4 at 1 ms, energies of order 10
}

// A bead that swings in a vertical plane is a pendulum; the multiplier is minus the rod's tension.
TEST(Constraints, MultiplierIsTheRodsForce) {
  const Vector3d x(0, 0, -1), v(3, 0, 0);
  const auto motion = solve_augmented(2 * MatrixXd::Identity(3, 3),
                                      Vector3d(0, 0, -2 * kStandardGravity), sphere(x, v), v, 0);
  EXPECT_LT((motion.acceleration - Vector3d(0, 0, 9)).norm(), 1e-13);
  EXPECT_NEAR(motion.multipliers(0), 2 * (9 + kStandardGravity), 1e-12);
}

TEST(Constraints, RedundantAndBadlyScaledRowsAreSolved) {
  Rng rng(6, Purpose::kTest);
  MatrixXd mass = MatrixXd::Identity(3, 3);
  mass(0, 0) = 1e-6;
  mass(2, 2) = 1e6;
  Constraint twice;
  twice.value = VectorXd::Zero(2);
  twice.convective = VectorXd::Zero(2);
  twice.jacobian = MatrixXd(2, 3);
  twice.jacobian << 1, 2, 3, 1, 2, 3;
  const Vector3d force = random_vector(rng, 3);
  const auto motion = solve_augmented(mass, force, twice, Vector3d::Zero(), 0);
  Constraint once{VectorXd::Zero(1), twice.jacobian.topRows(1), VectorXd::Zero(1)};
  const auto single = solve_augmented(mass, force, once, Vector3d::Zero(), 0);
  EXPECT_LT((twice.jacobian * motion.acceleration).norm(), 1e-9);
  EXPECT_LT((motion.acceleration - single.acceleration).norm(), 1e-9 * single.acceleration.norm());
  EXPECT_NEAR(motion.multipliers(0), motion.multipliers(1), 1e-9);
}

}  // namespace
}  // namespace walktrack
