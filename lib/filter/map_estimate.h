// The maximum of the posterior for a normal prior and a likelihood without derivatives.
//
// Newton steps with gradient and curvature from sigma points, which the unscented transform uses
// for moments (Julier & Uhlmann, Proc. IEEE 92, 2004): with P = S S' the present estimate of the
// posterior's covariance and points x +- h s_k, x + h (s_k + s_l) around the present estimate,
//   g_k  = (L(x + h s_k) - L(x - h s_k)) / 2h
//   C_kl = -(L(x + h (s_k + s_l)) - L(x + h s_k) - L(x + h s_l) + L(x)) / h^2, likewise C_kk,
// where h = sqrt(3) matches the fourth moment of a normal distribution. Curvature that is not
// concave is set to zero. The step that follows from likelihood and prior is damped until it is an
// improvement (Levenberg 1944, Marquardt 1963). Silhouettes are sums over pixels, so that
// differences over less than a pixel are meaningless: the spread of the points is that of the
// posterior. The result is exact after one step if L is quadratic.
#pragma once

#include <functional>
#include <span>

#include <Eigen/Core>

namespace walktrack {
inline namespace filter {

struct MapEstimate {
  Eigen::VectorXd at;
  Eigen::MatrixXd covariance;  // of the normal distribution that approximates the posterior there
  // Of the likelihood alone: minus the second derivatives of its concave part, positive
  // semidefinite.
  Eigen::MatrixXd information;
  double gain = 0;  // of the log-posterior over the prior's mean, nats
};

// Returns the log-likelihoods of all points, which are finite.
using LogLikelihoods =
    std::function<void(std::span<const Eigen::VectorXd> points, std::span<double> values)>;

// `mean`, `sd` > 0: of the prior's independent numbers. `rounds`: largest number of Newton steps.
MapEstimate map_estimate(const Eigen::VectorXd& mean, const Eigen::VectorXd& sd, int rounds,
                         const LogLikelihoods& log_likelihoods);

}  // namespace filter
}  // namespace walktrack
