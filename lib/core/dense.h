// Solvers for small dense systems. Eigen's are templates, which take seconds to compile for every
// size of matrix in every source; these are compiled once, for all sizes.
#pragma once

#include <functional>

#include <Eigen/Core>

namespace walktrack {
inline namespace core {

// The x of least norm among those that minimise |a x - b| (complete orthogonal decomposition: Golub
// & Van Loan 2013, 5.5.2).
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

// The pseudo-inverse, which maps any b to that x.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

// The eigenvalues of a square matrix, the largest absolute value first, and of a conjugate pair the
// one with the positive imaginary part first.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);

// Orthonormal columns that span the solutions of a x = 0. All of space if `a` has no rows.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& a);

// A symmetric matrix is vectors * diag(values) * vectors^T: the smallest eigenvalue first, and
// orthonormal columns.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& a);

// The lower triangular L with a = L L^T, of a positive definite matrix (Cholesky).
Eigen::MatrixXd cholesky_root(const Eigen::MatrixXd& a);

// The x of a x = b, where `a` is symmetric and positive definite (LDL^T).
Eigen::MatrixXd solve_positive(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// The minimum of a sum of squares.
struct LeastSquaresFit {
  Eigen::VectorXd x, residuals;
  Eigen::MatrixXd jacobian;  // d residuals / d x

  // (J^T J)^-1: the covariance of x if residuals are in standard deviations (Gauss & Markov).
  Eigen::MatrixXd covariance() const;
};

// The x near `start` that minimises the sum of squares of residuals(x) (Levenberg 1944, Marquardt
// 1963; MINPACK's, Moré 1978, in Eigen), with slopes by central differences: unknowns should be of
// the order of 1. The number of residuals is constant, and not less than that of unknowns.
LeastSquaresFit minimise_squares(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& residuals,
    const Eigen::VectorXd& start);

}  // namespace core
}  // namespace walktrack
