#include "filter/resampling.h"

#include <cmath>
#include <limits>

#include "core/log_weights.h"

namespace walktrack {
inline namespace filter {

bool systematic_resample(std::span<const double> log_weights, double u,
                         std::span<uint32_t> parents) {
  const double total = log_sum_exp(log_weights);
  if (total == -std::numeric_limits<double>::infinity()) return false;
  const double n = static_cast<double>(parents.size());
  // The last living particle takes the rounding error of the cumulative sum.
  size_t last = log_weights.size() - 1;
  while (log_weights[last] == -std::numeric_limits<double>::infinity()) --last;
  size_t chosen = 0;
  double cumulated = std::exp(log_weights[0] - total);
  for (size_t k = 0; k < parents.size(); ++k) {
    const double pointer = (static_cast<double>(k) + u) / n;
    while (cumulated <= pointer && chosen < last) {
      ++chosen;
      cumulated += std::exp(log_weights[chosen] - total);
    }
    parents[k] = static_cast<uint32_t>(chosen);
  }
  return true;
}

}  // namespace filter
}  // namespace walktrack
