#include "tracker/smooth/normal_equations.h"

#include <algorithm>

namespace walktrack {
inline namespace tracker {

namespace {

constexpr double kFaint = 1e-6;  // information of everything, so that nothing is unknown

}  // namespace

NormalEquations::NormalEquations(Eigen::Index size) : right_(Eigen::VectorXd::Zero(size)) {
  for (Eigen::Index i = 0; i < size; ++i) add(i, i, kFaint);
}

void NormalEquations::add(Eigen::Index row, Eigen::Index column, double value) {
  terms_.emplace_back(static_cast<int>(std::max(row, column)),
                      static_cast<int>(std::min(row, column)), value);
}

void NormalEquations::add(const SquareTerm& term) {
  for (size_t a = 0; a < term.slope.size(); ++a) {
    const auto& [row, x] = term.slope[a];
    right_[row] -= term.weight * x * term.residual;
    for (size_t b = 0; b <= a; ++b)
      add(row, term.slope[b].first, term.weight * x * term.slope[b].second);
  }
}

Eigen::SparseMatrix<double> NormalEquations::matrix() const {
  Eigen::SparseMatrix<double> out(right_.size(), right_.size());
  out.setFromTriplets(terms_.begin(), terms_.end());
  return out;
}

Eigen::VectorXd drawn(const Factor& factor, Rng& rng) {
  Eigen::VectorXd z(factor.vectorD().size());
  for (double& each : z) each = rng.normal();
  const Eigen::VectorXd scaled = z.cwiseQuotient(factor.vectorD().cwiseSqrt());
  return factor.permutationPinv() * factor.matrixU().solve(scaled);
}

}  // namespace tracker
}  // namespace walktrack
