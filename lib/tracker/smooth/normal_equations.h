// Sparse normal equations of a sum of squares, A x = b with A = sum of weight slope slope' and b =
// -sum of weight slope residual, and draws of the normal distribution whose inverse covariance is
// A.
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>

#include "core/rng.h"

namespace walktrack {
inline namespace tracker {

// One term of the sum: 1/2 weight (residual + slope . x)^2.
struct SquareTerm {
  double residual, weight;
  std::vector<std::pair<Eigen::Index, double>> slope;
};

class NormalEquations {
 public:
  explicit NormalEquations(Eigen::Index size);

  void add(const SquareTerm& term);
  // To an element of A and its mirror image: only one of (row, column) and (column, row).
  void add(Eigen::Index row, Eigen::Index column, double value);
  // To an element of b.
  void pull(Eigen::Index at, double by) { right_[at] += by; }

  Eigen::SparseMatrix<double> matrix() const;  // the lower triangle of A
  const Eigen::VectorXd& right() const { return right_; }

 private:
  std::vector<Eigen::Triplet<double>> terms_;
  Eigen::VectorXd right_;
};

using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower>;

// A draw of the normal distribution about zero whose inverse covariance has been factored: with
// P A P' = L D L', x = P' L'^-1 D^-1/2 z (Rue & Held, Gaussian Markov Random Fields, 2005,
// algorithm 2.4).
Eigen::VectorXd drawn(const Factor& factor, Rng& rng);

}  // namespace tracker
}  // namespace walktrack
