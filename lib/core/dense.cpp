#include "core/dense.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace walktrack {

using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

VectorXd least_squares(const MatrixXd& a, const VectorXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

MatrixXd pseudo_inverse(const MatrixXd& a) {
  return a.completeOrthogonalDecomposition().pseudoInverse();
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

}  // namespace walktrack
