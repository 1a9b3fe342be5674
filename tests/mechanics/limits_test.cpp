#include "mechanics/limits.h"

#include <algorithm>
#include <limits>
#include <optional>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "tests/mechanics/random_state.h"

namespace walktrack {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_positive(Rng& rng, Index n) {
  const MatrixXd a = random_vector(rng, n * n).reshaped(n, n);
  return a * a.transpose() + 0.1 * MatrixXd::Identity(n, n);
}

// The oracle: try every set of active rows and keep the one that satisfies all conditions.
std::optional<VectorXd> enumerate_sets(const MatrixXd& A, const VectorXd& b) {
  const Index n = b.size();
  for (int set = 0; set < (1 << n); ++set) {
    std::vector<Index> rows;
    for (Index i = 0; i < n; ++i) {
      if (set >> i & 1) rows.push_back(i);
    }
    VectorXd rho = VectorXd::Zero(n);
    if (!rows.empty()) {
      const MatrixXd part = A(rows, rows);
      const VectorXd right = -b(rows);
      const VectorXd solution = part.fullPivLu().solve(right);
      rho(rows) = solution;
    }
    if (rho.minCoeff() >= -1e-12 && (A * rho + b).minCoeff() >= -1e-12) return rho;
  }
  return std::nullopt;
}

TEST(Limits, ComplementarityEqualsEnumeration) {
  Rng rng(7, Purpose::kTest);
  for (int i = 0; i < 300; ++i) {
    const Index n = 1 + i % 6;
    const MatrixXd A = random_positive(rng, n);
    const VectorXd b = random_vector(rng, n);
    const VectorXd rho = solve_complementarity(A, b, std::vector<bool>(static_cast<size_t>(n)));
    EXPECT_LT((rho - *enumerate_sets(A, b)).norm(), 1e-10) << "case " << i;
  }
}

Limit limit(std::initializer_list<double> row, double bound = 0) {
  VectorXd a(static_cast<Index>(row.size()));
  std::copy(row.begin(), row.end(), a.begin());
  return {a, bound};
}

TEST(Limits, StopPushesButNeverPulls) {
  const MatrixXd mass = MatrixXd::Identity(2, 2);
  const std::vector<Limit> limits{limit({1, 0})};
  const std::vector<LimitRole> stop{LimitRole::kStop}, latch{LimitRole::kLatched};
  const VectorXd into = Eigen::Vector2d(-3, 1), away = Eigen::Vector2d(3, 1);
  EXPECT_EQ(solve_limited(mass, into, limits, stop).rate, Eigen::Vector2d(0, 1));
  EXPECT_EQ(solve_limited(mass, into, limits, stop).force(0), 3);
  EXPECT_EQ(solve_limited(mass, away, limits, stop).rate, away);
  EXPECT_EQ(solve_limited(mass, away, limits, stop).force(0), 0);
  EXPECT_EQ(solve_limited(mass, away, limits, latch).rate, Eigen::Vector2d(0, 1));
  EXPECT_EQ(solve_limited(mass, away, limits, latch).force(0), -3);
}

// A plastic impact is the projection of the velocity onto the feasible cone in the metric of M: it
// never increases kinetic energy, nor any violated rate.
TEST(Limits, PlasticImpactNeverGainsEnergy) {
  Rng rng(8, Purpose::kTest);
  for (int i = 0; i < 200; ++i) {
    const MatrixXd mass = random_positive(rng, 4);
    const VectorXd before = random_vector(rng, 4);
    const std::vector<Limit> limits{
        {random_vector(rng, 4), 0}, {random_vector(rng, 4), 0}, {random_vector(rng, 4), 0}};
    const std::vector<LimitRole> roles{LimitRole::kStop, LimitRole::kLatched, LimitRole::kStop};
    const LimitedMotion after = solve_limited(mass, mass * before, limits, roles);
    EXPECT_LE(after.rate.dot(mass * after.rate), before.dot(mass * before) + 1e-12);
    for (size_t k : {0u, 2u}) EXPECT_GE(limits[k].row.dot(after.rate), -1e-11);
    EXPECT_NEAR(limits[1].row.dot(after.rate), 0, 1e-11);
    EXPECT_GE(after.force(0), 0);
    EXPECT_GE(after.force(2), 0);
  }
}

TEST(Limits, TheSameStopTwiceSharesTheLoad) {
  const std::vector<Limit> limits{limit({1, 0}), limit({1, 0})};
  const std::vector<LimitRole> roles{LimitRole::kStop, LimitRole::kStop};
  const LimitedMotion motion =
      solve_limited(MatrixXd::Identity(2, 2), Eigen::Vector2d(-4, 0), limits, roles);
  EXPECT_NEAR(motion.force.sum(), 4, 1e-14);
  EXPECT_LT(motion.rate.norm(), 1e-14);
}

TEST(Limits, OpposedStopsWedgeThePart) {
  const std::vector<Limit> limits{limit({1, 0}), limit({-1, 0})};
  const std::vector<LimitRole> roles{LimitRole::kStop, LimitRole::kStop};
  const LimitedMotion motion =
      solve_limited(MatrixXd::Identity(2, 2), Eigen::Vector2d(-4, 2), limits, roles);
  EXPECT_NEAR(motion.rate(0), 0, 1e-14);
  EXPECT_NEAR(motion.rate(1), 2, 1e-14);
}

}  // namespace
}  // namespace walktrack
