#include "filter/map_estimate.h"

#include <array>
#include <vector>

#include "core/dense.h"

namespace walktrack {
inline namespace filter {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSpread = 1.7320508075688772;
constexpr double kFirstSpread = 0.5;  // relative to the prior's, at first
constexpr double kEnough = 0.1;       // nats; iteration ends after a smaller gain
constexpr double kNarrower = 0.5;     // factor of the spread after a round without a better step
constexpr std::array kDampings{0.0, 3.0, 30.0, 300.0};  // in precisions of the spread

// Points on both sides of x along every column of `root`, then along the sum of every pair of them.
std::vector<VectorXd> sigma_points(const VectorXd& x, const MatrixXd& root) {
  const Eigen::Index n = x.size();
  std::vector<VectorXd> points;
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

// Derivatives of the log-likelihood, in coordinates along the columns of the root.
struct Shape {
  VectorXd gradient;
  MatrixXd curvature;  // positive semidefinite: of its concave part
};

Shape shape(Eigen::Index n, double here, std::span<const double> at_points) {
  Shape out{VectorXd(n), MatrixXd(n, n)};
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
  const auto [values, axes] = symmetric_eigen(out.curvature);
  out.curvature = axes * values.cwiseMax(0).asDiagonal() * axes.transpose();
  return out;
}

MatrixXd root_of(const MatrixXd& covariance) {
  const auto [values, axes] = symmetric_eigen(covariance);
  return axes * values.cwiseMax(0).cwiseSqrt().asDiagonal();
}

}  // namespace

MapEstimate map_estimate(const VectorXd& mean, const VectorXd& sd, int rounds,
                         const LogLikelihoods& log_likelihoods) {
  const VectorXd precision = sd.cwiseInverse().cwiseAbs2();
  const auto at_one = [&](const VectorXd& point) {
    double value = 0;
    log_likelihoods(std::span(&point, 1), std::span(&value, 1));
    return value;
  };
  const Eigen::Index n = mean.size();
  MapEstimate out{mean, MatrixXd(sd.cwiseAbs2().asDiagonal()), MatrixXd::Zero(n, n), 0};
  MatrixXd around = kFirstSpread * kFirstSpread * out.covariance;
  double here = at_one(mean);
  const double at_mean = here;
  std::vector<double> values;
  for (int round = 0; round < rounds; ++round) {
    const MatrixXd root = root_of(around);
    const std::vector<VectorXd> points = sigma_points(out.at, root);
    values.resize(points.size());
    log_likelihoods(std::span<const VectorXd>(points), std::span(values));
    const Shape likelihood = shape(mean.size(), here, values);
    const MatrixXd posterior =
        root.transpose() * precision.asDiagonal() * root + likelihood.curvature;
    const VectorXd slope =
        likelihood.gradient - root.transpose() * precision.cwiseProduct(out.at - mean);
    around = root * solve_positive(posterior, root.transpose());
    // The columns of the root are orthogonal, so that its inverse is its transpose over their
    // squares.
    const MatrixXd inverse =
        root.colwise().squaredNorm().cwiseInverse().asDiagonal() * root.transpose();
    out.information = inverse.transpose() * likelihood.curvature * inverse;
    double gained = 0;
    for (const double damping : kDampings) {
      const MatrixXd damped = posterior + damping * MatrixXd::Identity(mean.size(), mean.size());
      const VectorXd tried = out.at + root * solve_positive(damped, slope);
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
    // If no step is better, the sigma points are too far apart for the width of the peak.
    if (gained == 0) around *= kNarrower * kNarrower;
    if (gained > 0 && gained < kEnough) break;
  }
  return out;
}

}  // namespace filter
}  // namespace walktrack
