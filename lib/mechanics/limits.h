// Inequality constraints a^T q >= b on generalised coordinates, for knee stops, latches and parts
// that cannot pass each other:
//   motion   M q_ddot = f + A^T rho,   rho >= 0,  A q_ddot >= 0,  rho^T A q_ddot = 0
//   impact   M (qd+ - qd-) = A^T rho,  rho >= 0,  A qd+ >= 0,     rho^T A qd+ = 0   (plastic)
// where A contains the active rows. A latched row acts in both directions: its rho has any sign.
// Simultaneous rows are solved together; dependent rows share the force.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace walktrack {
inline namespace mechanics {

struct Limit {
  Eigen::VectorXd row;  // a
  double bound = 0;     // b
};

// The role of a limit in one solve.
enum class LimitRole { kFree, kStop, kLatched };

struct LimitedMotion {
  Eigen::VectorXd rate;   // q_ddot or qd+
  Eigen::VectorXd force;  // rho for each limit, 0 if free
};

// `momentum` is f (motion) or M qd- (impact). Limits and roles have equal sizes.
LimitedMotion solve_limited(const Eigen::MatrixXd& mass, const Eigen::VectorXd& momentum,
                            std::span<const Limit> limits, std::span<const LimitRole> roles);

// rho with A rho + b >= 0, rho >= 0, rho^T (A rho + b) = 0 for a positive semidefinite A, by the
// active-set method of Lawson & Hanson (1974, ch. 23); entries with `equality` have any sign and
// (A rho + b) = 0.
Eigen::VectorXd solve_complementarity(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                      const std::vector<bool>& equality);

}  // namespace mechanics
}  // namespace walktrack
