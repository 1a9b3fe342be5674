#include "walker/limit_cycle.h"

#include <cmath>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

SectionRows no_rows(Eigen::Index n) {
  return [n](const VectorXd&) { return MatrixXd(0, n); };
}

// Henon's map x' = 1 - a x^2 + y, y' = b x: fixed point and multipliers in closed form.
ReturnMap henon(double a, double b) {
  return [=](const VectorXd& x) {
    return std::optional<VectorXd>(Vector2d(1 - a * x(0) * x(0) + x(1), b * x(0)));
  };
}

double henon_fixed_point(double a, double b) {
  return (-(1 - b) + std::sqrt((1 - b) * (1 - b) + 4 * a)) / (2 * a);
}

TEST(LimitCycle, FindsUnstableFixedPointsAndTheirMultipliers) {
  const double a = 1.4, b = 0.3, x = henon_fixed_point(a, b);
  const auto cycle = find_limit_cycle(henon(a, b), no_rows(2), Vector2d(0.5, 0.3));
  ASSERT_TRUE(cycle);
  EXPECT_NEAR(cycle->point(0), x, 1e-12);
  // lambda^2 + 2 a x lambda - b = 0
  const double root = std::sqrt(a * a * x * x + b);
  EXPECT_NEAR(cycle->multipliers(0).real(), -a * x - root, 1e-8);
  EXPECT_NEAR(cycle->multipliers(1).real(), -a * x + root, 1e-8);
  EXPECT_FALSE(cycle->is_stable());
}

// A curved section: the paraboloid z = x^2 + y^2, with the linear map diag(.5, -3) on it.
TEST(LimitCycle, StaysOnACurvedSection) {
  const ReturnMap map = [](const VectorXd& p) {
    const double x = 0.2 + 0.5 * (p(0) - 0.2), y = 0.1 - 3 * (p(1) - 0.1);
    return std::optional<VectorXd>(Vector3d(x, y, x * x + y * y));
  };
  const SectionRows rows = [](const VectorXd& p) {
    MatrixXd row(1, 3);
    row << 2 * p(0), 2 * p(1), -1;
    return row;
  };
  const auto cycle = find_limit_cycle(map, rows, Vector3d(0.4, 0.3, 0.25));
  ASSERT_TRUE(cycle);
  EXPECT_LT((cycle->point - Vector3d(0.2, 0.1, 0.05)).norm(), 1e-12);
  ASSERT_EQ(cycle->multipliers.size(), 2);
  EXPECT_NEAR(cycle->multipliers(0).real(), -3, 1e-7);
  EXPECT_NEAR(cycle->multipliers(1).real(), 0.5, 1e-7);
}

TEST(LimitCycle, ReportsWhenThereIsNone) {
  const ReturnMap drift = [](const VectorXd& x) {
    return std::optional<VectorXd>(x + VectorXd::Ones(1));
  };
  EXPECT_FALSE(find_limit_cycle(drift, no_rows(1), VectorXd::Zero(1)));
  const ReturnMap nowhere = [](const VectorXd&) { return std::optional<VectorXd>(); };
  EXPECT_FALSE(find_limit_cycle(nowhere, no_rows(1), VectorXd::Zero(1)));
}

TEST(LimitCycle, FollowsAFamilyAndStopsAtItsFold) {
  const MapFamily family{[](double a) { return henon(a, 0.3); }, [](double) { return no_rows(2); }};
  const double x = henon_fixed_point(0.2, 0.3);
  const auto there = follow_limit_cycle(family, Vector2d(x, 0.3 * x), 0.2, 1.4);
  ASSERT_TRUE(there.arrived);
  EXPECT_EQ(there.reached, 1.4);
  EXPECT_NEAR(there.cycle->point(0), henon_fixed_point(1.4, 0.3), 1e-11);
  EXPECT_TRUE(there.changes.empty());
  // The fixed points meet at a = -(1 - b)^2 / 4 = -.1225, where a multiplier is 1. The last share
  // of the way that is tried is 1/512 of .4.
  const auto lost = follow_limit_cycle(family, Vector2d(x, 0.3 * x), 0.2, -0.2);
  EXPECT_FALSE(lost.arrived);
  ASSERT_TRUE(lost.cycle);
  EXPECT_NEAR(lost.reached, -.1225, 1e-3);
  EXPECT_NEAR(lost.cycle->largest_multiplier(), 1, .1);
  EXPECT_FALSE(follow_limit_cycle(family, Vector2d(50, 50), -3, 1).cycle);
}

// A linear map towards a point: its fixed point and multiplier.
ReturnMap towards(double point, double multiplier) {
  return [=](const VectorXd& x) -> std::optional<VectorXd> {
    return point + multiplier * (x.array() - point);
  };
}

// At a = .5 the fixed point jumps farther than its change so far, or its multiplier does. Newton's
// method finds it from anywhere, so that only a comparison can detect it.
TEST(LimitCycle, SaysWhereItChangedTheBranch) {
  const auto followed = [](double leap, double multiplier_after, double to) {
    const MapFamily family{
        [=](double a) { return a < 0.5 ? towards(a, 0.3) : towards(a + leap, multiplier_after); },
        [](double) { return no_rows(1); }};
    return follow_limit_cycle(family, VectorXd::Zero(1), 0, to);
  };
  for (const auto& there : {followed(0.8, 0.3, 1), followed(0, -2, 1)}) {
    ASSERT_TRUE(there.arrived);
    ASSERT_EQ(there.changes.size(), 1u);
    EXPECT_LT(there.changes[0].from, 0.5);
    EXPECT_GE(there.changes[0].to, 0.5);
    EXPECT_LT(there.changes[0].to - there.changes[0].from, 0.005);
  }
  EXPECT_TRUE(followed(0, 0.3, 1).changes.empty());
  EXPECT_TRUE(followed(0.05, -2, 0.49).changes.empty());
}

// The circle x^2 + y^2 = 1, on which a map rotates towards a point and which it keeps, like an
// energy: for any guess, the fixed point has to be on it.
TEST(LimitCycle, KeepsWhatIsConserved) {
  const ReturnMap map = [](const VectorXd& p) -> std::optional<VectorXd> {
    const double angle = std::atan2(p(1), p(0));
    return p.norm() * Vector2d(std::cos(0.5 * angle), std::sin(0.5 * angle));
  };
  const SectionRows rows = [](const VectorXd& p) -> MatrixXd { return p.transpose(); };
  const SectionProjection onto = [](const VectorXd& p) -> std::optional<VectorXd> {
    return p.normalized();
  };
  for (const double guess : {0.3, 0.6, 0.9}) {
    const Vector2d start(std::cos(guess), std::sin(guess));
    const auto cycle = find_limit_cycle(map, rows, start, {}, onto);
    ASSERT_TRUE(cycle);
    EXPECT_LT((cycle->point - Vector2d(1, 0)).norm(), 1e-10);
    EXPECT_NEAR(cycle->multipliers(0).real(), 0.5, 1e-7);
  }
}

}  // namespace
}  // namespace walktrack
