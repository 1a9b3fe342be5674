#include "kinetics/smoothing.h"

#include <algorithm>
#include <cmath>

#include "core/conventions.h"

namespace walktrack {
inline namespace kinetics {

namespace {

// y_i = b (x_i + 2 x_(i-1) + x_(i-2)) - a1 y_(i-1) - a2 y_(i-2), by the bilinear transform.
struct Butterworth {
  double b, a1, a2;
};

Butterworth butterworth(double rate, double cutoff_hz) {
  const double passes = std::pow(std::sqrt(2.0) - 1, 0.25);
  const double w = std::tan(kPi * cutoff_hz / rate) / passes;
  const double scale = 1 / (1 + std::sqrt(2.0) * w + w * w);
  return {w * w * scale, 2 * (w * w - 1) * scale, (1 - std::sqrt(2.0) * w + w * w) * scale};
}

// Filters in place, as if the first value had been constant before.
void run(const Butterworth& f, std::vector<double>& x) {
  double x1 = x[0], x2 = x[0], y1 = x[0], y2 = x[0];
  for (double& each : x) {
    const double y = f.b * (each + 2 * x1 + x2) - f.a1 * y1 - f.a2 * y2;
    x2 = x1;
    x1 = each;
    y2 = y1;
    y1 = y;
    each = y;
  }
}

}  // namespace

std::vector<double> low_pass(std::span<const double> values, double rate, double cutoff_hz) {
  const size_t n = values.size();
  if (cutoff_hz <= 0 || cutoff_hz >= 0.5 * rate || n < 4) return {values.begin(), values.end()};
  constexpr double kSettled = 2;  // periods of the cut-off after which initial values have decayed
  const size_t pad = std::min(n - 1, static_cast<size_t>(std::ceil(kSettled * rate / cutoff_hz)));
  std::vector<double> x;
  x.reserve(n + 2 * pad);
  for (size_t k = pad; k > 0; --k) x.push_back(2 * values[0] - values[k]);
  x.insert(x.end(), values.begin(), values.end());
  for (size_t k = 1; k <= pad; ++k) x.push_back(2 * values[n - 1] - values[n - 1 - k]);
  const Butterworth filter = butterworth(rate, cutoff_hz);
  for (int pass = 0; pass < 2; ++pass) {
    run(filter, x);
    std::reverse(x.begin(), x.end());
  }
  return {x.begin() + static_cast<std::ptrdiff_t>(pad),
          x.begin() + static_cast<std::ptrdiff_t>(pad + n)};
}

std::vector<JointPositions> smoothed(const Motion& motion, const Span& span, double rate,
                                     double cutoff_hz) {
  std::vector<JointPositions> out(span.end - span.begin, unknown_joints());
  std::vector<double> column(out.size());
  for (size_t joint = 0; joint < kJointCount; ++joint) {
    bool whole = true;
    for (size_t i = span.begin; i < span.end; ++i)
      whole = whole && known(motion.joints[i].at[joint]);
    for (Eigen::Index axis = 0; whole && axis < 3; ++axis) {
      for (size_t i = 0; i < out.size(); ++i)
        column[i] = motion.joints[span.begin + i].at[joint][axis];
      const std::vector<double> smooth = low_pass(column, rate, cutoff_hz);
      for (size_t i = 0; i < out.size(); ++i) out[i].at[joint][axis] = smooth[i];
    }
  }
  return out;
}

}  // namespace kinetics
}  // namespace walktrack
