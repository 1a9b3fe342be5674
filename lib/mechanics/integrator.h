// One step of an ordinary differential equation dy/dt = f(t, y), for all models of the library.
//
//   kEuler     explicit Euler, order 1: the lecture's integrator.
//   kRk4       the classical Runge-Kutta method, order 4: the default.
//   kMidpoint  implicit midpoint rule, order 2: the structure-preserving one. It is symmetric in
//              time and conserves every quadratic invariant exactly (the norm of a quaternion,
//              energy and |L| of a free rigid body); Hairer, Lubich & Wanner, "Geometric Numerical
//              Integration", theorem IV.2.1. Stable for any stiffness.
#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

namespace walktrack {
inline namespace mechanics {

enum class Integrator { kEuler, kRk4, kMidpoint };

using Derivative = std::function<Eigen::VectorXd(double time, const Eigen::VectorXd& y)>;

// y(time + dt). nullopt if the step diverged: the result is not finite, or the implicit equations
// of the midpoint rule could not be solved.
std::optional<Eigen::VectorXd> integrate_step(Integrator integrator, const Derivative& derivative,
                                              double time, double dt, const Eigen::VectorXd& y);

}  // namespace mechanics
}  // namespace walktrack
