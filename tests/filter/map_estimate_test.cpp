#include "filter/map_estimate.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "core/rng.h"

namespace walktrack {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

// Evaluates the function for many points and counts them.
template <typename F>
auto for_all(const F& f, int* count = nullptr) {
  return [=](std::span<const Vector> points, std::span<double> values) {
    for (size_t i = 0; i < points.size(); ++i) values[i] = f(points[i]);
    if (count) *count += static_cast<int>(points.size());
  };
}

Vector drawn(Eigen::Index n, Rng& rng) {
  Vector out(n);
  for (double& x : out) x = rng.normal();
  return out;
}

// Kalman's update, for any number of correlated measurements, in one step.
TEST(MapEstimate, IsExactForNormalLikelihoods) {
  Rng rng(1, Purpose::kTest);
  for (Eigen::Index n = 1; n <= 6; ++n) {
    const Vector mean = drawn(n, rng), sd = drawn(n, rng).cwiseAbs() + Vector::Constant(n, 0.2);
    const Vector peak = drawn(n, rng);
    Matrix a(n, n);
    for (Eigen::Index k = 0; k < n; ++k) a.col(k) = drawn(n, rng);
    const Matrix information = a * a.transpose();
    const auto found = map_estimate(mean, sd, 1, for_all([&](const Vector& x) {
                                      return 7 - 0.5 * (x - peak).dot(information * (x - peak));
                                    }));
    const Matrix prior = sd.cwiseAbs2().cwiseInverse().asDiagonal();
    const Matrix covariance = (prior + information).inverse();
    const Vector at = covariance * (prior * mean + information * peak);
    EXPECT_LT((found.at - at).norm(), 1e-9 * (1 + at.norm())) << n;
    EXPECT_LT((found.covariance - covariance).norm(), 1e-9) << n;
    EXPECT_LT((found.information - information).norm(), 1e-9 * (1 + information.norm())) << n;
  }
}

// Compared with a grid, for a posterior that is neither normal nor concave everywhere.
TEST(MapEstimate, ClimbsToThePeakOfOtherOnes) {
  const auto f = [](const Vector& x) {
    const double ridge = x[1] - 0.4 * x[0];
    return -40 * std::log1p(ridge * ridge) - 3 * std::cosh(x[0] - 1.2);
  };
  const Vector mean = Eigen::Vector2d(0.2, 0.5), sd = Eigen::Vector2d(1, 1.5);
  const auto posterior = [&](const Vector& x) {
    return f(x) - 0.5 * (x - mean).cwiseQuotient(sd).squaredNorm();
  };
  Vector best = mean;
  for (int i = -200; i <= 400; ++i) {
    for (int k = -200; k <= 400; ++k) {
      const Vector x = Eigen::Vector2d(0.005 * i, 0.005 * k);
      if (posterior(x) > posterior(best)) best = x;
    }
  }
  const auto found = map_estimate(mean, sd, 10, for_all(f));
  EXPECT_NEAR(found.gain, posterior(best) - posterior(mean), 0.1);  // it stops at gains of a tenth
  const Vector off = found.at - best;
  EXPECT_LT(off.dot(found.covariance.inverse() * off), 0.25) << "half a standard deviation";
}

// Between two peaks, where the likelihood is convex.
TEST(MapEstimate, LeavesAMinimumBetweenTwoPeaks) {
  const auto f = [](const Vector& x) { return -30 * std::abs(std::abs(x[0]) - 1); };
  const Vector mean = Vector::Constant(1, 0.15), sd = Vector::Constant(1, 1);
  const auto found = map_estimate(mean, sd, 8, for_all(f));
  EXPECT_GT(f(found.at), f(mean) + 20);
}

// An edge that is far sharper than the prior, unlike any normal distribution.
TEST(MapEstimate, ClimbsSharpEdges) {
  const Vector edge = Eigen::Vector4d(0.8, -1.1, 0.5, 1.4);
  const auto f = [&](const Vector& x) { return -200 * (x - edge).cwiseAbs().maxCoeff(); };
  const Vector mean = Vector::Zero(4), sd = Vector::Ones(4);
  const auto found = map_estimate(mean, sd, 8, for_all(f));
  EXPECT_GT(found.gain, 0.6 * -f(mean));
}

TEST(MapEstimate, StaysWhereNothingIsSaid) {
  const Vector mean = Eigen::Vector3d(1, -2, 3), sd = Eigen::Vector3d(0.1, 2, 1);
  const auto found = map_estimate(mean, sd, 4, for_all([](const Vector&) { return -5.0; }));
  EXPECT_EQ(found.at, mean);
  EXPECT_EQ(found.gain, 0);
  EXPECT_LT((found.covariance - Matrix(sd.cwiseAbs2().asDiagonal())).norm(), 1e-12);
}

// Steps like those of a silhouette over pixels, and larger ones.
TEST(MapEstimate, NeverEndsBelowThePriorsMean) {
  Rng rng(2, Purpose::kTest);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector mean = drawn(4, rng), sd = Vector::Constant(4, 0.5), wave = 9 * drawn(4, rng);
    const auto f = [&](const Vector& x) { return 8 * std::round(std::sin(wave.dot(x))); };
    int count = 0;
    const auto found = map_estimate(mean, sd, 5, for_all(f, &count));
    const double gain = f(found.at) - f(mean) - 0.5 * ((found.at - mean) / 0.5).squaredNorm();
    EXPECT_NEAR(found.gain, gain, 1e-9);
    EXPECT_GE(found.gain, 0);
    EXPECT_LE(count, 1 + 5 * (8 + 6 + 4));
    EXPECT_TRUE(found.at.allFinite() && found.covariance.allFinite());
  }
}

TEST(MapEstimate, NoRoundsLeaveThePrior) {
  const Vector mean = Eigen::Vector2d(1, 2), sd = Eigen::Vector2d(1, 1);
  EXPECT_EQ(map_estimate(mean, sd, 0, for_all([](const Vector& x) { return x[0]; })).at, mean);
}

}  // namespace
}  // namespace walktrack
