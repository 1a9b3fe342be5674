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

#include <functional>
#include <span>

#include <Eigen/Core>

namespace walktrack {
inline namespace filter {

struct MapEstimate {
  Eigen::VectorXd at;
  Eigen::MatrixXd covariance;  // of the normal distribution that the posterior resembles there
  // Of the likelihood alone: minus the second derivatives of its concave part, positive
  // semidefinite.
  Eigen::MatrixXd information;
  double gain = 0;  // in log-posterior against the prior's mean, nats
};

// Evaluates the log-likelihood of every point, in any order: finite values.
using LogLikelihoods =
    std::function<void(std::span<const Eigen::VectorXd> points, std::span<double> values)>;

// `mean`, `sd` > 0: of the prior's independent numbers. `rounds`: Newton steps at most.
MapEstimate map_estimate(const Eigen::VectorXd& mean, const Eigen::VectorXd& sd, int rounds,
                         const LogLikelihoods& log_likelihoods);

}  // namespace filter
}  // namespace walktrack
