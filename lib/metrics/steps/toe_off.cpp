#include "metrics/steps/toe_off.h"

#include <algorithm>

namespace walktrack {
inline namespace metrics {

std::optional<double> toe_off_time(std::span<const double> time, std::span<const double> speed,
                                   size_t turn, double pelvis) {
  constexpr double kHighestWithin = 0.5;  // s, of the turn; longer than half of a swing
  const auto last = std::upper_bound(time.begin(), time.end(), time[turn] + kHighestWithin);
  const auto first = speed.begin() + static_cast<std::ptrdiff_t>(turn);
  const auto highest = std::max_element(first, speed.begin() + (last - time.begin()));
  if (highest + 1 >= speed.end() || *highest <= 0) return {};
  const double half = 0.5 * *highest;
  auto after = highest;
  while (after != speed.begin() && *(after - 1) > half) --after;
  if (after == speed.begin()) return {};
  const size_t row = static_cast<size_t>(after - speed.begin());
  const double share = (half - speed[row - 1]) / (speed[row] - speed[row - 1]);
  const double half_time = time[row - 1] + share * (time[row] - time[row - 1]);
  return half_time - kRiseTime * (kHalfSpeed - std::clamp(pelvis / *highest, 0.0, 1.0));
}

}  // namespace metrics
}  // namespace walktrack
