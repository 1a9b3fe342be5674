#include "mechanics/constraints.h"

#include <cmath>

#include "core/dense.h"

namespace walktrack {
inline namespace mechanics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Solves [M E^T; E 0][x; y] = [a; b]. Rows and columns are scaled to unit size first, so that mass
// ratios do not affect the rank decision of the complete orthogonal decomposition.
ConstrainedMotion solve_saddle(const MatrixXd& mass, const MatrixXd& E, const VectorXd& a,
                               const VectorXd& b) {
  const Index n = mass.rows(), m = E.rows();
  MatrixXd saddle = MatrixXd::Zero(n + m, n + m);
  saddle.topLeftCorner(n, n) = mass;
  saddle.topRightCorner(n, m) = E.transpose();
  saddle.bottomLeftCorner(m, n) = E;
  VectorXd scale = VectorXd::Ones(n + m);
  for (Index i = 0; i < n; ++i) {
    if (mass(i, i) > 0) scale(i) = 1 / std::sqrt(mass(i, i));
  }
  for (Index i = 0; i < m; ++i) {
    const double size = (E.row(i).transpose().cwiseProduct(scale.head(n))).norm();
    if (size > 0) scale(n + i) = 1 / size;
  }
  VectorXd right(n + m);
  right << a, b;
  const MatrixXd scaled = scale.asDiagonal() * saddle * scale.asDiagonal();
  const VectorXd solution = scale.cwiseProduct(least_squares(scaled, scale.cwiseProduct(right)));
  return {solution.head(n), solution.tail(m)};
}

}  // namespace

ConstrainedMotion solve_augmented(const MatrixXd& mass, const VectorXd& force,
                                  const Constraint& constraint, const VectorXd& velocity,
                                  double baumgarte_rate) {
  const double r = baumgarte_rate;
  const VectorXd e_dot = constraint.jacobian * velocity;
  return solve_saddle(mass, constraint.jacobian, force,
                      -constraint.convective - 2 * r * e_dot - r * r * constraint.value);
}

VectorXd position_correction(const MatrixXd& mass, const Constraint& constraint) {
  return solve_saddle(mass, constraint.jacobian, VectorXd::Zero(mass.rows()), -constraint.value)
      .acceleration;
}

VectorXd projected_velocity(const MatrixXd& mass, const Constraint& constraint,
                            const VectorXd& velocity) {
  return solve_saddle(mass, constraint.jacobian, mass * velocity,
                      VectorXd::Zero(constraint.jacobian.rows()))
      .acceleration;
}

}  // namespace mechanics
}  // namespace walktrack
