#include "core/dense.h"

#include <complex>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd rank_one() {
  MatrixXd out(2, 4);
  out << 1, 2, 3, 4, 2, 4, 6, 8;
  return out;
}

// The residual is orthogonal to the range of `a`, the solution to its null space.
TEST(LeastSquares, IsShortestOfTheBest) {
  const MatrixXd a = rank_one();
  const VectorXd b = Eigen::Vector2d(1, 5), x = least_squares(a, b);
  EXPECT_LT((a.transpose() * (a * x - b)).norm(), 1e-13);
  EXPECT_LT((null_space(a).transpose() * x).norm(), 1e-14);
  EXPECT_LT((pseudo_inverse(a) * b - x).norm(), 1e-14);
}

TEST(NullSpace, IsOrthonormal) {
  const MatrixXd N = null_space(rank_one());
  EXPECT_EQ(N.cols(), 3);
  EXPECT_LT((rank_one() * N).norm(), 1e-13);
  EXPECT_LT((N.transpose() * N - MatrixXd::Identity(3, 3)).norm(), 1e-14);
  EXPECT_EQ(null_space(MatrixXd(0, 4)), MatrixXd::Identity(4, 4));
}

TEST(Eigenvalues, AreInOrder) {
  MatrixXd turning(3, 3);  // a quarter turn, scaled by two, and a shrinking axis
  turning << 0, -2, 0, 2, 0, 0, 0, 0, 0.5;
  const Eigen::VectorXcd values = eigenvalues(turning);
  EXPECT_LT(std::abs(values(0) - std::complex<double>(0, 2)), 1e-14);
  EXPECT_LT(std::abs(values(1) - std::complex<double>(0, -2)), 1e-14);
  EXPECT_LT(std::abs(values(2) - 0.5), 1e-14);
  EXPECT_EQ(eigenvalues(MatrixXd()).size(), 0);
}

MatrixXd symmetric_three() {
  MatrixXd out(3, 3);
  out << 4, 1, -1, 1, 3, 0.5, -1, 0.5, 2;
  return out;
}

TEST(SymmetricEigen, PutsTheMatrixTogetherAgain) {
  const auto [values, vectors] = symmetric_eigen(symmetric_three());
  EXPECT_LT(values[0], values[1]);
  EXPECT_LT(values[1], values[2]);
  EXPECT_LT((vectors.transpose() * vectors - MatrixXd::Identity(3, 3)).norm(), 1e-14);
  EXPECT_LT((vectors * values.asDiagonal() * vectors.transpose() - symmetric_three()).norm(),
            1e-14);
}

TEST(CholeskyRoot, IsLowerTriangularAndSquaresToTheMatrix) {
  const MatrixXd root = cholesky_root(symmetric_three());
  EXPECT_EQ(root(0, 1), 0);
  EXPECT_EQ(root(0, 2), 0);
  EXPECT_EQ(root(1, 2), 0);
  EXPECT_LT((root * root.transpose() - symmetric_three()).norm(), 1e-14);
}

// Rows and columns of very unequal size, as masses and inertias are.
TEST(SolvePositive, SolvesForEveryColumn) {
  const Eigen::Vector3d size(1, 1e3, 1e-4);
  const MatrixXd a = size.asDiagonal() * symmetric_three() * size.asDiagonal();
  MatrixXd x(3, 2);
  x << 1, -2, 3e-3, 0, 5e4, 1;
  const MatrixXd found = solve_positive(a, a * x);
  EXPECT_LT((size.asDiagonal() * (found - x)).norm(), 1e-12);
}

// Rosenbrock's valley, whose only minimum is at (1, 1).
TEST(MinimiseSquares, FollowsAValley) {
  const LeastSquaresFit fit = minimise_squares(
      [](const VectorXd& x) {
        return VectorXd(Eigen::Vector2d(10 * (x[1] - x[0] * x[0]), 1 - x[0]));
      },
      Eigen::Vector2d(-1.2, 1));
  EXPECT_LT((fit.x - Eigen::Vector2d(1, 1)).norm(), 1e-8);
  EXPECT_LT(fit.residuals.norm(), 1e-8);
}

// The mean of n numbers with standard deviation 1 has the standard deviation 1 / sqrt(n).
TEST(MinimiseSquares, StatesTheUncertainty) {
  const Eigen::Vector4d numbers(1, 2, 4, 9);
  const LeastSquaresFit fit = minimise_squares(
      [&](const VectorXd& x) { return VectorXd(numbers.array() - x[0]); }, VectorXd::Zero(1));
  EXPECT_NEAR(fit.x[0], 4, 1e-9);
  EXPECT_NEAR(fit.covariance()(0, 0), 0.25, 1e-9);
}

}  // namespace
}  // namespace walktrack
