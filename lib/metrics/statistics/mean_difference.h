// The difference between the means of two groups of curves (or numbers: curves of one point), with
// a confidence band by bootstrap.
//
// Curves are drawn with replacement within each group. For every draw
//   T = max over the points of |difference* - difference| / SE*,
// where SE* is the draw's own standard error; the band is difference -/+ q SE, where q is the
// `level` quantile of T: the bootstrap-t (Efron & Tibshirani, An Introduction to the Bootstrap,
// 1993, chapter 12), for the whole curve at once by its maximum (Lenhoff et al., Gait & Posture 9,
// 1999). With probability `level` all of the true curve is inside, not each of its points alone.
// Draws in which all curves of a group are the same contain no information on errors and are
// ignored.
//
// For generated strides the band contains the truth in 100 % of cases with 3 or 5 curves in each
// group, 98 % with 8 and 97 % with 15, where 95 % are wanted: with few strides it is too wide, not
// too narrow.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace walktrack {
inline namespace metrics {

inline constexpr size_t kLeastForBand = 3;  // curves in either group

struct MeanDifference {
  std::vector<double> difference;  // mean of `a` minus mean of `b`, at every point
  std::vector<double> low, high;   // NaN with fewer than kLeastForBand curves in a group
};

// Every curve is finite and of the same length, either group has at least one. `level` in (0, 1).
// The same inputs and seed give the same band.
MeanDifference mean_difference(std::span<const std::vector<double>> a,
                               std::span<const std::vector<double>> b, double level, size_t draws,
                               uint64_t seed);

// Mean and standard deviation (n - 1; NaN for one number) of at least one number.
struct SampleSpread {
  size_t count = 0;
  double mean, sd;
};
SampleSpread sample_spread(std::span<const double> values);

// The quantile of Student's t above which the probability is `tail`, in (0, 0.5); 1 to 1000 degrees
// of freedom.
double students_t(double tail, double degrees);

}  // namespace metrics
}  // namespace walktrack
