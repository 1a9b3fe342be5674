#include "observation/two_views/step_time.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace walktrack {
inline namespace observation {

namespace {

constexpr double kQuickest = 0.3, kSlowest = 0.85;  // s, of steps: children to slow old people
constexpr double kRepeats = 0.3;                    // least autocorrelation at the time of a step
constexpr double kRounding = 1e-18;                 // of heights that are all equal
constexpr double kAsWell = 0.8;                     // relative to the highest peak
constexpr double kNearShare = 0.15;                 // of a step, within which lags are equivalent

// Heights minus their mean over the second around them; NaN if less than half of it is known.
std::vector<double> without_trend(const std::vector<double>& heights, int half) {
  const int frames = static_cast<int>(heights.size());
  std::vector<double> out(heights.size(), std::nan(""));
  for (int t = half; t + half < frames; ++t) {
    double sum = 0;
    int count = 0;
    for (int i = t - half; i <= t + half; ++i) {
      const double each = heights[static_cast<size_t>(i)];
      if (!std::isfinite(each)) continue;
      sum += each;
      ++count;
    }
    if (count > half) out[static_cast<size_t>(t)] = heights[static_cast<size_t>(t)] - sum / count;
  }
  return out;
}

double autocorrelation(const std::vector<double>& values, size_t lag) {
  double product = 0, first = 0, second = 0;
  for (size_t t = 0; t + lag < values.size(); ++t) {
    const double a = values[t], b = values[t + lag];
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    product += a * b;
    first += a * a;
    second += b * b;
  }
  return first * second > kRounding ? product / std::sqrt(first * second) : 0;
}

}  // namespace

std::optional<double> step_time(const std::vector<double>& heights, double frame_rate) {
  const auto frames_in = [&](double seconds) {
    return static_cast<size_t>(std::max(1L, std::lround(seconds * frame_rate)));
  };
  const std::vector<double> moving = without_trend(heights, static_cast<int>(frames_in(0.5)));
  std::vector<std::pair<size_t, double>> peaks;
  double most = kRepeats;
  for (size_t lag = frames_in(kQuickest); lag <= frames_in(kSlowest); ++lag) {
    const double here = autocorrelation(moving, lag);
    if (here < kRepeats || here < autocorrelation(moving, lag - 1) ||
        here < autocorrelation(moving, lag + 1))
      continue;
    peaks.emplace_back(lag, here);
    most = std::max(most, here);
  }
  // A signal repeats after two steps as well as after one.
  for (const auto& [lag, value] : peaks)
    if (value >= kAsWell * most) return static_cast<double>(lag) / frame_rate;
  return std::nullopt;
}

bool is_whole_steps(double time, double step) {
  const double steps = std::abs(time) / step;
  return steps > 0.5 && std::abs(steps - std::round(steps)) <= kNearShare;
}

}  // namespace observation
}  // namespace walktrack
