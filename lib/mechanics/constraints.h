// Explicit constraints e(x) = 0 by the augmented system, E = de/dx:
//   [ M  E^T ] [ x_ddot ]   [           f             ]
//   [ E   0  ] [ lambda ] = [ -Ed xd - 2 r e_dot - r^2 e ]
// The constraint force is -E^T lambda. With r = 0 the constraint drifts; r > 0 is Baumgarte's
// stabilisation (1972), critically damped with rate r in 1/s; the third choice, projection,
// corrects position and velocity after each step. M may be singular as long as the whole matrix is
// not; redundant constraints get the smallest multipliers.
#pragma once

#include <Eigen/Core>

namespace walktrack {
inline namespace mechanics {

struct Constraint {
  Eigen::VectorXd value;       // e(x)
  Eigen::MatrixXd jacobian;    // E
  Eigen::VectorXd convective;  // Ed xd, the acceleration of e while x_ddot = 0
};

struct ConstrainedMotion {
  Eigen::VectorXd acceleration;
  Eigen::VectorXd multipliers;  // lambda
};

ConstrainedMotion solve_augmented(const Eigen::MatrixXd& mass, const Eigen::VectorXd& force,
                                  const Constraint& constraint, const Eigen::VectorXd& velocity,
                                  double baumgarte_rate);

// How the integration of a constrained system corrects drift.
enum class Stabilisation { kNone, kBaumgarte, kProjection };

// The smallest dx in the norm of M with E dx = -e: one Newton step of the projection.
Eigen::VectorXd position_correction(const Eigen::MatrixXd& mass, const Constraint& constraint);

// The velocity nearest to v in the norm of M with E v = 0. This is also the velocity after a
// plastic impact against the constraint.
Eigen::VectorXd projected_velocity(const Eigen::MatrixXd& mass, const Constraint& constraint,
                                   const Eigen::VectorXd& velocity);

}  // namespace mechanics
}  // namespace walktrack
