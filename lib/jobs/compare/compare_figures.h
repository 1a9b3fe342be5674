// The differences between groups, side by side.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "jobs/compare/compare_trials.h"
#include "metrics/statistics/mean_difference.h"

namespace walktrack {
inline namespace jobs {

inline constexpr double kCompareLevel = 0.95;  // of confidence intervals

// The strides of some sides of a group: one column of the comparison.
struct Sample {
  std::string name;  // of the group, or "left", "right"
  const ComparedGroup* group;
  std::vector<size_t> sides;  // indices of ComparedTrial::sides
};

// Samples that are compared with the first of them.
struct Comparison {
  std::string side;  // "both", "left", "right"; "" if the samples are the sides
  std::vector<Sample> samples;
};

// For one group, left against right (its `right` first). For several: both sides, left, right.
std::vector<Comparison> comparisons_of(const std::vector<ComparedGroup>& groups);

// The units of the bootstrap: a curve for each whole stride, or the mean of each trial.
std::vector<std::vector<double>> drawn_curves(const Sample& sample, size_t angle, CompareUnit unit);
std::vector<double> drawn_values(const Sample& sample, size_t parameter, CompareUnit unit);

struct ParameterDifference {
  double difference, low, high;  // NaN where unknown
  double detectable;             // the minimal detectable change; NaN for fewer than two numbers
  bool with_bands;               // whether it includes the results' own bands
  bool exceeds() const;          // whether the difference is larger than that
};

// Sample minus reference, both of which have numbers.
ParameterDifference parameter_difference(const Sample& sample, const Sample& reference,
                                         size_t parameter, const CompareJob& job);

}  // namespace jobs
}  // namespace walktrack
