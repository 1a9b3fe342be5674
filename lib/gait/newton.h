// Newton's method and continuation for cycles of any walker; internal to lib/gait.
#pragma once

#include <algorithm>
#include <optional>

#include "core/dense.h"
#include "gait/prior/prior_table.h"

namespace walktrack {
inline namespace gait {

// Minimum-norm Gauss-Newton from `guess` to a residual below 1e-9; nullopt if it does not converge.
// residual(gait) and jacobian(gait) return optional matrices: nullopt if no step is walked.
template <typename Gait, typename Residual, typename Jacobian>
std::optional<Gait> newton(const Gait& guess, const Residual& residual, const Jacobian& jacobian) {
  // By hand: a step that does not reduce the residual after seven halvings has failed.
  constexpr double kConverged = 1e-9;
  constexpr int kMaxIterations = 15;
  constexpr int kMaxHalvings = 7;
  Gait at = guess;
  auto now = residual(at);
  for (int i = 0; now && i < kMaxIterations; ++i) {
    if (now->norm() < kConverged) return at;
    const auto slope = jacobian(at);
    if (!slope) return std::nullopt;
    const Gait step = least_squares(*slope, -*now);
    // The first of the halved steps that reduces the residual.
    double share = 1;
    auto next = now;
    for (int k = 0; k < kMaxHalvings; ++k, share /= 2) {
      next = residual(at + share * step);
      if (next && next->norm() < now->norm()) break;
      next.reset();
    }
    if (next) at += share * step;
    now = next;
  }
  return std::nullopt;
}

// Continues along the straight line between two targets in as few steps as find(guess, target)
// allows.
template <typename Gait, typename Find>
std::optional<Gait> continued(Gait at, const GaitTarget& from, const GaitTarget& to,
                              const Find& find) {
  constexpr double kSmallestShare = 1.0 / 64;  // share of the way below which the gait is given up;
                                               // by hand
  double done = 0, share = 1;
  while (done < 1) {
    const double next = std::min(1.0, done + share);
    const auto between = [&](double a, double b) { return a + next * (b - a); };
    const GaitTarget target{between(from.speed, to.speed),
                            between(from.step_length, to.step_length),
                            between(from.slope, to.slope)};
    if (const std::optional<Gait> found = find(at, target)) {
      at = *found;
      done = next;
    } else if ((share /= 2) < kSmallestShare) {
      return std::nullopt;
    }
  }
  return at;
}

}  // namespace gait
}  // namespace walktrack
