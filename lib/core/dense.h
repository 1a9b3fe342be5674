// Solvers for small dense systems. Eigen's are templates, which take seconds to compile for every
// size of matrix and every source; these are compiled once, for all sizes.
#pragma once

#include <functional>

#include <Eigen/Core>

namespace walktrack {
inline namespace core {

// The x of least norm among those that minimise |a x - b| (complete orthogonal decomposition: Golub
// & Van Loan 2013, 5.5.2).
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

// The matrix that takes every b there.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

// Of a square matrix, the largest absolute value first, of a conjugate pair that with the positive
// imaginary part.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);

// Orthonormal columns that span the x with a x = 0. All of space where `a` has no rows.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& a);

// Where a sum of squares is least.
struct LeastSquaresFit {
  Eigen::VectorXd x, residuals;
  Eigen::MatrixXd jacobian;  // d residuals / d x

  // (J^T J)^-1: of x, where residuals are in standard deviations (Gauss & Markov).
  Eigen::MatrixXd covariance() const;
};

// The x near `start` at which the squares of residuals(x) add up to the least (Levenberg 1944,
// Marquardt 1963; MINPACK's, Moré 1978, in Eigen), with slopes by central differences: unknowns are
// to be of the order of 1. There are at least as many residuals as unknowns, always as many.
LeastSquaresFit minimise_squares(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& residuals,
    const Eigen::VectorXd& start);

}  // namespace core
}  // namespace walktrack
