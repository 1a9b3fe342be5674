#include "core/dense.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <unsupported/Eigen/NonLinearOptimization>

namespace walktrack {
inline namespace core {

using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

using Residuals = std::function<VectorXd(const VectorXd&)>;

constexpr int kMostEvaluations = 200;
constexpr double kDifference = 1e-5;  // step for slopes: the cube root of the precision of a double

MatrixXd slopes(const Residuals& residuals, const VectorXd& x) {
  MatrixXd out;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    VectorXd above = x, below = x;
    above[k] += kDifference;
    below[k] -= kDifference;
    const VectorXd slope = (residuals(above) - residuals(below)) / (2 * kDifference);
    if (k == 0) out.resize(slope.size(), x.size());
    out.col(k) = slope;
  }
  return out;
}

// The problem in the form that Eigen's solver expects.
struct Problem {
  const Residuals& of;
  Eigen::Index count;

  Eigen::Index values() const { return count; }
  int operator()(const VectorXd& x, VectorXd& out) const {
    out = of(x);
    return 0;
  }
  int df(const VectorXd& x, MatrixXd& out) const {
    out = slopes(of, x);
    return 0;
  }
};

}  // namespace

VectorXd least_squares(const MatrixXd& a, const VectorXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

MatrixXd pseudo_inverse(const MatrixXd& a) {
  const MatrixXd unit = MatrixXd::Identity(a.rows(), a.rows());
  return a.completeOrthogonalDecomposition().solve(unit);
}

VectorXcd eigenvalues(const MatrixXd& a) {
  if (a.rows() == 0) return {};
  VectorXcd values = a.eigenvalues();
  std::sort(values.begin(), values.end(), [](auto one, auto other) {
    return std::abs(one) != std::abs(other) ? std::abs(one) > std::abs(other)
                                            : one.imag() > other.imag();
  });
  return values;
}

MatrixXd null_space(const MatrixXd& a) {
  if (a.rows() == 0) return MatrixXd::Identity(a.cols(), a.cols());
  const Eigen::JacobiSVD<MatrixXd> svd(a, Eigen::ComputeFullV);
  return svd.matrixV().rightCols(a.cols() - svd.rank());
}

SymmetricEigen symmetric_eigen(const MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

MatrixXd cholesky_root(const MatrixXd& a) { return a.llt().matrixL(); }

MatrixXd solve_positive(const MatrixXd& a, const MatrixXd& b) { return a.ldlt().solve(b); }

MatrixXd LeastSquaresFit::covariance() const {
  return pseudo_inverse(jacobian.transpose() * jacobian);
}

LeastSquaresFit minimise_squares(const Residuals& residuals, const VectorXd& start) {
  LeastSquaresFit out{start, residuals(start), {}};
  Problem problem{residuals, out.residuals.size()};
  Eigen::LevenbergMarquardt<Problem> solver(problem);
  solver.parameters.maxfev = kMostEvaluations;
  solver.minimize(out.x);
  out.residuals = residuals(out.x);
  out.jacobian = slopes(residuals, out.x);
  return out;
}

}  // namespace core
}  // namespace walktrack
