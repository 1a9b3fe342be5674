// The most probable state under a normal prior and a likelihood that can only be evaluated.
//
// Newton steps whose gradient and curvature are read off sigma points, as the unscented transform
// reads moments (Julier & Uhlmann, Proc. IEEE 92, 2004): with P = S S' the present guess of the
// posterior's covariance and x +- h s_k, x + h (s_k + s_l) around the present estimate,
//   g_k  = (L(x + h s_k) - L(x - h s_k)) / 2h
//   C_kl = -(L(x + h (s_k + s_l)) - L(x + h s_k) - L(x + h s_l) + L(x)) / h^2, likewise C_kk,
// h = sqrt(3), the spread that a normal distribution's fourth moment asks for. What is not concave
// counts as flat. The step that they and the prior ask for is damped until it is better (Levenberg
// 1944, Marquardt 1963).
// Silhouettes are sums over pixels, so differences over less than a pixel say nothing: spreads of
// the posterior's own size say what it is about. Exact in one step where L is quadratic.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace walktrack {

// At most N numbers, on the stack.
template <int N>
using BoundedVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, N, 1>;
template <int N>
using BoundedMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, N, N>;

template <int N>
struct MapEstimate {
  BoundedVector<N> at;
  BoundedMatrix<N> covariance;  // of the normal distribution that the posterior resembles there
  double gain = 0;              // in log-posterior against the prior's mean, nats
};

namespace map_detail {

inline constexpr double kSpread = 1.7320508075688772;
inline constexpr double kFirstSpread = 0.5;  // of the prior's, before anything is known
inline constexpr double kEnough = 0.1;       // nats; a smaller gain is the last one
inline constexpr double kNarrower = 0.5;
inline constexpr std::array kDampings{0.0, 3.0, 30.0, 300.0};

// x, then both sides of it along every column of `root`, then every pair's sum.
template <int N>
std::vector<BoundedVector<N>> sigma_points(const BoundedVector<N>& x,
                                           const BoundedMatrix<N>& root) {
  const Eigen::Index n = x.size();
  std::vector<BoundedVector<N>> points;
  points.reserve(static_cast<size_t>(2 * n + n * (n - 1) / 2));
  for (Eigen::Index k = 0; k < n; ++k) {
    points.push_back(x + kSpread * root.col(k));
    points.push_back(x - kSpread * root.col(k));
  }
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index l = 0; l < k; ++l)
      points.push_back(x + kSpread * (root.col(k) + root.col(l)));
  return points;
}

// Of the log-likelihood, in coordinates along the columns of the root.
template <int N>
struct Shape {
  BoundedVector<N> gradient;
  BoundedMatrix<N> curvature;  // positive semidefinite: of its concave part
};

template <int N>
Shape<N> shape(Eigen::Index n, double here, std::span<const double> at_points) {
  Shape<N> out{BoundedVector<N>(n), BoundedMatrix<N>(n, n)};
  const auto plus = [&](Eigen::Index k) { return at_points[static_cast<size_t>(2 * k)]; };
  const auto minus = [&](Eigen::Index k) { return at_points[static_cast<size_t>(2 * k + 1)]; };
  size_t pair = static_cast<size_t>(2 * n);
  for (Eigen::Index k = 0; k < n; ++k) {
    out.gradient[k] = (plus(k) - minus(k)) / (2 * kSpread);
    out.curvature(k, k) = (2 * here - plus(k) - minus(k)) / (kSpread * kSpread);
    for (Eigen::Index l = 0; l < k; ++l)
      out.curvature(k, l) = out.curvature(l, k) =
          (plus(k) + plus(l) - here - at_points[pair++]) / (kSpread * kSpread);
  }
  const Eigen::SelfAdjointEigenSolver<BoundedMatrix<N>> axes(out.curvature);
  out.curvature = axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).asDiagonal() *
                  axes.eigenvectors().transpose();
  return out;
}

template <int N>
BoundedMatrix<N> root_of(const BoundedMatrix<N>& covariance) {
  const Eigen::SelfAdjointEigenSolver<BoundedMatrix<N>> axes(covariance);
  return axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

}  // namespace map_detail

// `mean`, `sd` > 0: of the prior's independent numbers. `rounds`: Newton steps at most.
// log_likelihoods(points, values) evaluates them, in any order; values finite.
template <int N, typename LogLikelihoods>
MapEstimate<N> map_estimate(const BoundedVector<N>& mean, const BoundedVector<N>& sd, int rounds,
                            const LogLikelihoods& log_likelihoods) {
  using namespace map_detail;
  using Vector = BoundedVector<N>;
  using Matrix = BoundedMatrix<N>;
  const Vector precision = sd.cwiseInverse().cwiseAbs2();
  const auto at_one = [&](const Vector& point) {
    double value = 0;
    log_likelihoods(std::span(&point, 1), std::span(&value, 1));
    return value;
  };
  MapEstimate<N> out{mean, Matrix(sd.cwiseAbs2().asDiagonal()), 0};
  Matrix around = kFirstSpread * kFirstSpread * out.covariance;
  double here = at_one(mean);
  const double at_mean = here;
  std::vector<double> values;
  for (int round = 0; round < rounds; ++round) {
    const Matrix root = root_of<N>(around);
    const std::vector<Vector> points = sigma_points<N>(out.at, root);
    values.resize(points.size());
    log_likelihoods(std::span<const Vector>(points), std::span(values));
    const Shape<N> likelihood = shape<N>(mean.size(), here, values);
    const Matrix posterior =
        root.transpose() * precision.asDiagonal() * root + likelihood.curvature;
    const Vector slope =
        likelihood.gradient - root.transpose() * precision.cwiseProduct(out.at - mean);
    around = root * posterior.ldlt().solve(Matrix(root.transpose()));
    double gained = 0;
    for (const double damping : kDampings) {
      const Matrix damped = posterior + damping * Matrix::Identity(mean.size(), mean.size());
      const Vector tried = out.at + root * damped.ldlt().solve(slope);
      const double there = at_one(tried);
      const double gain = there - at_mean - 0.5 * precision.dot((tried - mean).cwiseAbs2());
      if (gain <= out.gain) continue;
      gained = gain - out.gain;
      out.at = tried;
      out.gain = gain;
      here = there;
      break;
    }
    out.covariance = around;
    // No step is better where sigma points lie too far apart to see the shape of the peak.
    if (gained == 0) around *= kNarrower * kNarrower;
    if (gained > 0 && gained < kEnough) break;
  }
  return out;
}

}  // namespace walktrack
