// The differences between groups, side by side.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "jobs/compare/compare_trials.h"
#include "metrics/statistics/mean_difference.h"

namespace walktrack {
inline namespace jobs {

inline constexpr double kCompareLevel = 0.95;

// The strides of some sides of a group: one column of the comparison.
struct Sample {
  std::string name;  // of the group, or "left", "right"
  const ComparedGroup* group;
  std::vector<size_t> sides;  // indices of ComparedTrial::sides
};

// Samples that are compared with the first of them.
struct Comparison {
  std::string side;  // "both", "left", "right"; "" where the samples are the sides
  std::vector<Sample> samples;
};

// Of one group: left against right (its `right` first). Of more: both sides, left, right.
std::vector<Comparison> comparisons_of(const std::vector<ComparedGroup>& groups);

// What is drawn in the bootstrap: a curve for each whole stride, or the mean of each trial's.
std::vector<std::vector<double>> drawn_curves(const Sample& sample, size_t angle, CompareUnit unit);
std::vector<double> drawn_values(const Sample& sample, size_t parameter, CompareUnit unit);

struct ParameterDifference {
  double difference, low, high;  // NaN where unknown
  double detectable;             // the minimal detectable change; NaN with less than two numbers
  bool with_bands;               // whether the results' own bands are part of it
  bool exceeds() const;          // more than is detectable
};

// Sample minus reference. Both have numbers.
ParameterDifference parameter_difference(const Sample& sample, const Sample& reference,
                                         size_t parameter, const CompareJob& job);

}  // namespace jobs
}  // namespace walktrack
