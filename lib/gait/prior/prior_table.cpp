#include "gait/prior/prior_table.h"

#include <algorithm>
#include <cmath>

#include "core/conventions.h"

namespace walktrack {
inline namespace gait {
namespace {

// Four neighbours on an axis with their weights, see NodeShare.
struct AxisWeights {
  std::array<size_t, 4> index{};
  std::array<double, 4> cubic{};
  std::array<double, 4> linear{};
};

AxisWeights axis_weights(const std::vector<double>& axis, double value) {
  AxisWeights w;
  if (axis.size() == 1) {
    w.cubic = w.linear = {0, 1, 0, 0};
    return w;
  }
  const auto above = std::upper_bound(axis.begin() + 1, axis.end() - 1, value);
  const auto i = static_cast<size_t>(above - axis.begin()) - 1;
  const size_t before = i == 0 ? i : i - 1, after = std::min(i + 2, axis.size() - 1);
  const double width = axis[i + 1] - axis[i];
  const double t = std::clamp((value - axis[i]) / width, 0.0, 1.0);
  const double left = width * t * (1 - t) * (1 - t) / (axis[i + 1] - axis[before]);
  const double right = -width * t * t * (1 - t) / (axis[after] - axis[i]);
  const double rise = t * t * (3 - 2 * t);
  w.index = {before, i, i + 1, after};
  w.linear = {0, 1 - t, t, 0};
  w.cubic = {-left, 1 - rise - right, rise + left, right};
  return w;
}

}  // namespace

double preferred_step_length(double speed) {
  constexpr double kLeg = 0.9275, kStep = 0.694, kSpeed = 1.25;
  return kStep / kLeg * std::pow(speed * std::sqrt(kStandardGravity * kLeg) / kSpeed, 0.42);
}

GaitTarget within(const PriorAxes& axes, GaitTarget target) {
  target.speed = std::clamp(target.speed, axes.speeds.front(), axes.speeds.back());
  const double preferred = preferred_step_length(target.speed);
  target.step_length = std::clamp(target.step_length, preferred * axes.ratios.front(),
                                  preferred * axes.ratios.back());
  target.slope = std::clamp(target.slope, axes.slopes.front(), axes.slopes.back());
  return target;
}

NodeShares node_shares(const PriorAxes& axes, const GaitTarget& at) {
  const double ratio = at.step_length / preferred_step_length(at.speed);
  const AxisWeights s = axis_weights(axes.speeds, at.speed);
  const AxisWeights r = axis_weights(axes.ratios, ratio);
  const AxisWeights g = axis_weights(axes.slopes, at.slope);
  NodeShares shares;
  for (size_t i = 0; i < 4; ++i)
    for (size_t j = 0; j < 4; ++j)
      for (size_t k = 0; k < 4; ++k) {
        const double cubic = s.cubic[i] * r.cubic[j] * g.cubic[k];
        const double linear = s.linear[i] * r.linear[j] * g.linear[k];
        if (cubic == 0 && linear == 0) continue;
        shares.shares[shares.count++] = {axes.at(s.index[i], r.index[j], g.index[k]), cubic,
                                         linear};
      }
  return shares;
}

GaitTarget shifted(GaitTarget target) {
  constexpr double kShift = 0.1;  // share of the way to the preferred step length; by hand
  target.step_length += kShift * (preferred_step_length(target.speed) - target.step_length);
  return target;
}

size_t nearest_index(const std::vector<double>& axis, double value) {
  size_t best = 0;
  for (size_t i = 1; i < axis.size(); ++i)
    if (std::abs(axis[i] - value) < std::abs(axis[best] - value)) best = i;
  return best;
}

}  // namespace gait
}  // namespace walktrack
