#include "walker/limit_cycle.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include <Eigen/LU>

#include "core/dense.h"

namespace walktrack {
inline namespace walker {
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

struct Iterate {
  VectorXd x, image;
  double residual() const { return (image - x).norm(); }
};

ReturnMap on_section(const ReturnMap& map, const SectionProjection& onto) {
  return [&map, &onto](const VectorXd& x) {
    const auto image = map(x);
    return image ? onto(*image) : image;
  };
}

std::optional<Iterate> evaluated(const ReturnMap& map, const SectionProjection& onto,
                                 const VectorXd& near) {
  const auto x = onto ? onto(near) : near;
  const auto image = x ? map(*x) : std::nullopt;
  if (!image || image->size() != x->size()) return std::nullopt;
  return Iterate{*x, *image};
}

// x + s N d, with the part off the tangent space taken from the image of x.
std::optional<Iterate> damped_step(const ReturnMap& map, const SectionProjection& onto,
                                   const Iterate& now, const MatrixXd& N, const VectorXd& d,
                                   int halvings) {
  double s = 1;
  for (int i = 0; i < halvings; ++i, s /= 2) {
    const auto tangent = evaluated(map, onto, now.x + s * N * d);
    if (!tangent) continue;
    const VectorXd miss = tangent->image - tangent->x;
    auto next = evaluated(map, onto, tangent->x + miss - N * (N.transpose() * miss));
    // Far from the solution a step may increase the residual slightly.
    if (next && next->residual() < 1.5 * now.residual()) return next;
  }
  return std::nullopt;
}

// Coefficients of prod (1 - multiplier_i z), without the first. Unlike the multipliers they are
// continuous where two of them meet, and a multiplier that is zero does not change them.
VectorXcd characteristic(const VectorXcd& multipliers, Index size) {
  VectorXcd coefficients = VectorXcd::Zero(size + 1);
  coefficients(0) = 1;
  for (Index i = 0; i < multipliers.size(); ++i) {
    for (Index k = i + 1; k > 0; --k) coefficients(k) -= multipliers(i) * coefficients(k - 1);
  }
  return coefficients.tail(size);
}

// Whether `found` is near the prediction from the branch of `before` and has nearly the same
// stability. Along a branch both differences shrink with the step, between branches they do not.
// The limits are set by hand.
bool continues(const LimitCycle& before, const LimitCycle& found, const VectorXd& predicted) {
  constexpr double kOff = 0.5;          // share of the way of the point
  constexpr double kNear = 1e-3;        // share of the point's own size below which differences are
                                        // ignored
  constexpr double kOtherStable = 0.5;  // change of a coefficient, of 1 + its size
  const double come = (found.point - before.point).norm();
  const double off = (found.point - predicted).norm();
  if (off > std::max(kOff * come, kNear * (1 + before.point.norm()))) return false;
  const Index size = std::max(before.multipliers.size(), found.multipliers.size());
  const VectorXcd was = characteristic(before.multipliers, size);
  const VectorXcd is = characteristic(found.multipliers, size);
  return ((is - was).array().abs() <= kOtherStable * (1 + was.array().abs())).all();
}

}  // namespace

double LimitCycle::largest_multiplier() const {
  return multipliers.size() > 0 ? std::abs(multipliers(0)) : 0.0;
}

std::optional<LimitCycle> find_limit_cycle(const ReturnMap& plain_map, const SectionRows& rows,
                                           const VectorXd& guess, const CycleOptions& options,
                                           const SectionProjection& onto) {
  const ReturnMap map = onto ? on_section(plain_map, onto) : plain_map;
  auto now = evaluated(map, onto, guess);
  double previous = 0;
  for (int i = 0; now && i <= options.max_iterations; ++i) {
    const MatrixXd N = null_space(rows(now->x));
    const auto A = reduced_jacobian(map, now->x, N, options.difference_step);
    if (!A) return std::nullopt;
    const bool close = now->residual() < options.tolerance;
    // One more step after the tolerance is reached, if it still reduces the residual.
    if (close && previous > 0 && now->residual() > 0.1 * previous) {
      return LimitCycle{now->x, now->residual(), N, *A, eigenvalues(*A), i};
    }
    previous = now->residual();
    const VectorXd d = (MatrixXd::Identity(N.cols(), N.cols()) - *A)
                           .fullPivLu()
                           .solve(N.transpose() * (now->image - now->x));
    const auto next = damped_step(map, onto, *now, N, d, options.max_halvings);
    if (!next && close) {
      return LimitCycle{now->x, now->residual(), N, *A, eigenvalues(*A), i};
    }
    now = next;
  }
  return std::nullopt;
}

FollowedCycle follow_limit_cycle(const MapFamily& family, const VectorXd& guess, double from,
                                 double to, const CycleOptions& options) {
  constexpr double kFirstShare = 0.25, kSmallestShare = 2e-3,
                   kTangentShare = 1e-4;  // of the way; by hand
  const auto at = [&](double share) { return from + share * (to - from); };
  const auto cycle_at = [&](double share, const VectorXd& near_it, const CycleOptions& how) {
    const double value = at(share);
    const SectionProjection onto = family.onto ? family.onto(value) : SectionProjection{};
    return find_limit_cycle(family.map(value), family.rows(value), near_it, how, onto);
  };
  FollowedCycle followed{cycle_at(0, guess, options)};
  followed.reached = from;
  CycleOptions near = options;  // a good prediction needs few iterations, a bad one needs a shorter
                                // step
  near.max_iterations = std::min(options.max_iterations, 8);
  near.max_halvings = std::min(options.max_halvings, 3);
  // The prediction of the cycle's change, by the share of the way.
  const auto tangent = [&](double share) -> VectorXd {
    const VectorXd& here = followed.cycle->point;
    const double length = std::min(kTangentShare, 1 - share);
    const auto beside = length > 0 ? cycle_at(share + length, here, near) : std::nullopt;
    return beside ? VectorXd((beside->point - here) / length) : VectorXd::Zero(here.size());
  };
  double done = 0, step = kFirstShare;
  bool grows = true;  // not directly after a failure, because another one would follow
  VectorXd slope = followed.cycle ? tangent(0) : VectorXd();
  while (followed.cycle && done < 1 && step >= kSmallestShare) {
    const double next = std::min(1.0, done + step);
    const VectorXd predicted = followed.cycle->point + (next - done) * slope;
    const auto found = cycle_at(next, predicted, near);
    const bool goes_on = found && continues(*followed.cycle, *found, predicted);
    if (!found || (!goes_on && step / 2 >= kSmallestShare)) {
      step /= 2;
      grows = false;
      continue;
    }
    slope = (found->point - followed.cycle->point) / (next - done);
    followed.cycle = found;
    if (!goes_on) {
      followed.changes.push_back({at(done), at(next)});
      slope = tangent(next);
    }
    done = next;
    followed.reached = at(done);
    step = grows ? std::min(2 * step, 1.0) : step;
    grows = true;
  }
  followed.arrived = followed.cycle && done == 1;
  return followed;
}

}  // namespace walker
}  // namespace walktrack
