#include "mechanics/integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace walktrack {
inline namespace mechanics {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Newton on m = y + dt/2 f(m) stops when an update changes m by no more than rounding; if updates
// stop decreasing above kStalled, the step has failed.
constexpr double kConverged = 4 * std::numeric_limits<double>::epsilon();
constexpr double kStalled = 1e-10;
// Fixed-point steps halve a smooth residual and are cheap; Newton's method does the rest. By hand.
constexpr int kMaxFixedPoint = 8;
constexpr int kMaxNewton = 40;

VectorXd rk4_step(const Derivative& f, double t, double dt, const VectorXd& y) {
  const VectorXd k1 = f(t, y);
  const VectorXd k2 = f(t + dt / 2, y + dt / 2 * k1);
  const VectorXd k3 = f(t + dt / 2, y + dt / 2 * k2);
  const VectorXd k4 = f(t + dt, y + dt * k3);
  return y + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

// I - dt/2 df/dy by forward differences.
MatrixXd newton_matrix(const Derivative& f, double t, double dt, const VectorXd& m,
                       const VectorXd& f_m) {
  constexpr double kRelativeStep = 1e-7;  // about the square root of the rounding error
  MatrixXd matrix = MatrixXd::Identity(m.size(), m.size());
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    VectorXd moved = m;
    const double step = kRelativeStep * std::max(1.0, std::abs(m(i)));
    moved(i) += step;
    matrix.col(i) -= dt / 2 * (f(t, moved) - f_m) / (moved(i) - m(i));
  }
  return matrix;
}

double relative_size(const VectorXd& update, const VectorXd& m) {
  return update.lpNorm<Eigen::Infinity>() / std::max(1.0, m.lpNorm<Eigen::Infinity>());
}

// The midpoint m = y + dt/2 f(m), by fixed-point iteration if that converges fast, otherwise by
// Newton's method.
std::optional<VectorXd> solve_midpoint(const Derivative& f, double t, double dt,
                                       const VectorXd& y) {
  VectorXd m = y + dt / 2 * f(t, y);
  for (int i = 0; i < kMaxFixedPoint && m.allFinite(); ++i) {
    const VectorXd next = y + dt / 2 * f(t, m);
    const double change = relative_size(next - m, next);
    m = next;
    if (change <= kConverged) return m;
  }
  if (!m.allFinite()) m = y;
  Eigen::PartialPivLU<MatrixXd> factors;
  double previous = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMaxNewton; ++i) {
    const VectorXd f_m = f(t, m);
    if (!f_m.allFinite()) return std::nullopt;
    if (i < 4 || i % 4 == 0) factors.compute(newton_matrix(f, t, dt, m, f_m));
    const VectorXd update = factors.solve(y + dt / 2 * f_m - m);
    m += update;
    const double change = relative_size(update, m);
    if (!std::isfinite(change)) return std::nullopt;
    if (change <= kConverged || (change <= kStalled && change >= previous)) return m;
    previous = change;
  }
  if (previous <= kStalled) return m;
  return std::nullopt;
}

}  // namespace

std::optional<VectorXd> integrate_step(Integrator integrator, const Derivative& derivative,
                                       double time, double dt, const VectorXd& y) {
  std::optional<VectorXd> next;
  switch (integrator) {
    case Integrator::kEuler:
      next = y + dt * derivative(time, y);
      break;
    case Integrator::kRk4:
      next = rk4_step(derivative, time, dt, y);
      break;
    case Integrator::kMidpoint:
      if (const auto m = solve_midpoint(derivative, time + dt / 2, dt, y)) next = 2 * *m - y;
      break;
  }
  if (next && !next->allFinite()) next.reset();
  return next;
}

}  // namespace mechanics
}  // namespace walktrack
