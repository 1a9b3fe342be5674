// Summary of a set of errors.
#pragma once

#include <cstddef>
#include <vector>

namespace walktrack {
inline namespace metrics {

// All zero for an empty set. Quantiles are those of the sorted values at rank q (n - 1),
// interpolated linearly.
struct ErrorStatistics {
  size_t count = 0;
  double mean = 0, median = 0, p95 = 0, rms = 0, worst = 0;
};

ErrorStatistics error_statistics(std::vector<double> values);

// Quantile q in [0, 1] of values (not empty) by that rule.
double quantile(std::vector<double> values, double q);

}  // namespace metrics
}  // namespace walktrack
