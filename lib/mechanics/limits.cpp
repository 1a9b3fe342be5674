#include "mechanics/limits.h"

#include <cmath>

#include "core/dense.h"

namespace walktrack {
inline namespace mechanics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A row counts as violated if it exceeds the rounding error of its terms.
constexpr double kRounding = 1e-13;

// Solves A_pp x_p = -b_p on the rows in use, 0 elsewhere.
VectorXd solve_on(const MatrixXd& A, const VectorXd& b, const std::vector<bool>& used) {
  std::vector<Index> rows;
  for (Index i = 0; i < b.size(); ++i) {
    if (used[static_cast<size_t>(i)]) rows.push_back(i);
  }
  VectorXd x = VectorXd::Zero(b.size());
  if (rows.empty()) return x;
  const MatrixXd part = A(rows, rows);
  x(rows) = least_squares(part, -b(rows));
  return x;
}

// The unused unilateral row with the largest violation; -1 if there is none.
Index most_violated(const MatrixXd& A, const VectorXd& b, const VectorXd& rho,
                    const std::vector<bool>& used) {
  const VectorXd gap = A * rho + b;
  const VectorXd size = A.cwiseAbs() * rho.cwiseAbs() + b.cwiseAbs();
  Index worst = -1;
  for (Index i = 0; i < b.size(); ++i) {
    if (used[static_cast<size_t>(i)] || gap(i) >= -kRounding * size(i)) continue;
    if (worst < 0 || gap(i) < gap(worst)) worst = i;
  }
  return worst;
}

// Moves rho towards `target` until the first unilateral row in use reaches zero, and removes that
// row. Returns false if the target is feasible (then rho = target).
bool blocked(const VectorXd& target, const std::vector<bool>& equality, VectorXd& rho,
             std::vector<bool>& used) {
  double step = 1;
  Index block = -1;
  for (Index i = 0; i < rho.size(); ++i) {
    const auto k = static_cast<size_t>(i);
    if (!used[k] || equality[k] || target(i) > 0) continue;
    const double reach = rho(i) > 0 ? rho(i) / (rho(i) - target(i)) : 0;
    if (block < 0 || reach < step) {
      step = reach;
      block = i;
    }
  }
  rho += (block < 0 ? 1 : step) * (target - rho);
  if (block < 0) return false;
  rho(block) = 0;
  used[static_cast<size_t>(block)] = false;
  return true;
}

}  // namespace

VectorXd solve_complementarity(const MatrixXd& A, const VectorXd& b,
                               const std::vector<bool>& equality) {
  std::vector<bool> used = equality;
  VectorXd rho = solve_on(A, b, used);
  const Index rounds = 4 * b.size() + 4;  // the method is finite; this limits cycles by rounding
  for (Index round = 0; round < rounds; ++round) {
    const Index worst = most_violated(A, b, rho, used);
    if (worst < 0) break;
    used[static_cast<size_t>(worst)] = true;
    while (blocked(solve_on(A, b, used), equality, rho, used)) {
    }
  }
  return rho;
}

LimitedMotion solve_limited(const MatrixXd& mass, const VectorXd& momentum,
                            std::span<const Limit> limits, std::span<const LimitRole> roles) {
  LimitedMotion motion{solve_positive(mass, momentum),
                       VectorXd::Zero(static_cast<Index>(limits.size()))};
  std::vector<size_t> acting;
  std::vector<bool> latched;
  for (size_t i = 0; i < limits.size(); ++i) {
    if (roles[i] == LimitRole::kFree) continue;
    acting.push_back(i);
    latched.push_back(roles[i] == LimitRole::kLatched);
  }
  if (acting.empty()) return motion;
  MatrixXd rows(static_cast<Index>(acting.size()), mass.rows());
  for (size_t i = 0; i < acting.size(); ++i) {
    rows.row(static_cast<Index>(i)) = limits[acting[i]].row.transpose();
  }
  const MatrixXd response = solve_positive(mass, rows.transpose());  // M^-1 A^T
  const VectorXd rho = solve_complementarity(rows * response, rows * motion.rate, latched);
  motion.rate += response * rho;
  for (size_t i = 0; i < acting.size(); ++i) {
    motion.force(static_cast<Index>(acting[i])) = rho(static_cast<Index>(i));
  }
  return motion;
}

}  // namespace mechanics
}  // namespace walktrack
