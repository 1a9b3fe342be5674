#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>

namespace walktrack {
inline namespace metrics {

namespace {

double quantile_of_sorted(const std::vector<double>& sorted, double q) {
  const double rank = q * static_cast<double>(sorted.size() - 1);
  const size_t low = static_cast<size_t>(rank);
  const size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (rank - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

}  // namespace

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return quantile_of_sorted(values, q);
}

ErrorStatistics error_statistics(std::vector<double> values) {
  ErrorStatistics out;
  if (values.empty()) return out;
  std::sort(values.begin(), values.end());
  out.count = values.size();
  const double n = static_cast<double>(values.size());
  for (const double value : values) {
    out.mean += value / n;
    out.rms += value * value / n;
    out.worst = std::max(out.worst, std::abs(value));
  }
  out.rms = std::sqrt(out.rms);
  out.median = quantile_of_sorted(values, 0.5);
  out.p95 = quantile_of_sorted(values, 0.95);
  return out;
}

}  // namespace metrics
}  // namespace walktrack
