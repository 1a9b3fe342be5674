#include "walker/limit_cycle.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace walktrack {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

// A = N' DP N by central differences.
std::optional<MatrixXd> reduced_jacobian(const ReturnMap& map, const VectorXd& x, const MatrixXd& N,
                                         double h) {
  MatrixXd jacobian(N.cols(), N.cols());
  for (Index i = 0; i < N.cols(); ++i) {
    const auto plus = map(x + h * N.col(i)), minus = map(x - h * N.col(i));
    if (!plus || !minus || plus->size() != x.size() || minus->size() != x.size()) {
      return std::nullopt;
    }
    jacobian.col(i) = N.transpose() * (*plus - *minus) / (2 * h);
  }
  return jacobian;
}

VectorXcd sorted_eigenvalues(const MatrixXd& matrix) {
  if (matrix.rows() == 0) return {};
  VectorXcd values = matrix.eigenvalues();
  std::sort(values.begin(), values.end(), [](auto a, auto b) {
    return std::abs(a) != std::abs(b) ? std::abs(a) > std::abs(b) : a.imag() > b.imag();
  });
  return values;
}

struct Iterate {
  VectorXd x, image;
  double residual() const { return (image - x).norm(); }
};

std::optional<Iterate> evaluated(const ReturnMap& map, const VectorXd& x) {
  const auto image = map(x);
  if (!image || image->size() != x.size()) return std::nullopt;
  return Iterate{x, *image};
}

// x + s N d, with the part off the tangent space taken from the image.
std::optional<Iterate> damped_step(const ReturnMap& map, const Iterate& now, const MatrixXd& N,
                                   const VectorXd& d, int halvings) {
  double s = 1;
  for (int i = 0; i < halvings; ++i, s /= 2) {
    const auto tangent = evaluated(map, now.x + s * N * d);
    if (!tangent) continue;
    const VectorXd miss = tangent->image - tangent->x;
    auto next = evaluated(map, tangent->x + miss - N * (N.transpose() * miss));
    // Far away a step may raise the residual a little on its way to the basin.
    if (next && next->residual() < 1.5 * now.residual()) return next;
  }
  return std::nullopt;
}

}  // namespace

double LimitCycle::largest_multiplier() const {
  return multipliers.size() > 0 ? std::abs(multipliers(0)) : 0.0;
}

MatrixXd null_space(const MatrixXd& rows, Index n) {
  if (rows.rows() == 0) return MatrixXd::Identity(n, n);
  const Eigen::JacobiSVD<MatrixXd> svd(rows, Eigen::ComputeFullV);
  return svd.matrixV().rightCols(n - svd.rank());
}

std::optional<LimitCycle> find_limit_cycle(const ReturnMap& map, const SectionRows& rows,
                                           const VectorXd& guess, const CycleOptions& options) {
  auto now = evaluated(map, guess);
  double previous = 0;
  for (int i = 0; now && i <= options.max_iterations; ++i) {
    const MatrixXd N = null_space(rows(now->x), now->x.size());
    const auto A = reduced_jacobian(map, now->x, N, options.difference_step);
    if (!A) return std::nullopt;
    const bool close = now->residual() < options.tolerance;
    // One step beyond the tolerance, as long as it still helps.
    if (close && previous > 0 && now->residual() > 0.1 * previous) {
      return LimitCycle{now->x, now->residual(), N, *A, sorted_eigenvalues(*A), i};
    }
    previous = now->residual();
    const VectorXd d = (MatrixXd::Identity(N.cols(), N.cols()) - *A)
                           .fullPivLu()
                           .solve(N.transpose() * (now->image - now->x));
    const auto next = damped_step(map, *now, N, d, options.max_halvings);
    if (!next && close) {
      return LimitCycle{now->x, now->residual(), N, *A, sorted_eigenvalues(*A), i};
    }
    now = next;
  }
  return std::nullopt;
}

FollowedCycle follow_limit_cycle(const MapFamily& family, const VectorXd& guess, double from,
                                 double to, const CycleOptions& options) {
  constexpr double kFirstShare = 0.25, kSmallestShare = 2e-3;  // of the way
  const auto at = [&](double share) { return from + share * (to - from); };
  FollowedCycle followed{find_limit_cycle(family.map(from), family.rows(from), guess, options)};
  followed.reached = from;
  CycleOptions near = options;  // a good predictor needs few iterations, a bad one a shorter step
  near.max_iterations = std::min(options.max_iterations, 8);
  near.max_halvings = std::min(options.max_halvings, 3);
  double done = 0, step = kFirstShare;
  bool grows = true;  // not right after a failure: another would follow
  VectorXd slope = VectorXd::Zero(guess.size());
  while (followed.cycle && done < 1 && step >= kSmallestShare) {
    const double next = std::min(1.0, done + step);
    const VectorXd predicted = followed.cycle->point + (next - done) * slope;
    const auto start = family.onto ? family.onto(at(next), predicted) : predicted;
    const auto found =
        start ? find_limit_cycle(family.map(at(next)), family.rows(at(next)), *start, near)
              : std::nullopt;
    if (!found) {
      step /= 2;
      grows = false;
      continue;
    }
    slope = (found->point - followed.cycle->point) / (next - done);
    followed.cycle = found;
    done = next;
    followed.reached = at(done);
    step = grows ? std::min(2 * step, 1.0) : step;
    grows = true;
  }
  followed.arrived = followed.cycle && done == 1;
  return followed;
}

}  // namespace walktrack
