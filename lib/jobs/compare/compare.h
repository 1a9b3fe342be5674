// `walktrack compare`: the differences between groups of results (before and after, two
// treatments), or between the left and the right side of one group, in joint angles over the gait
// cycle and in gait parameters, as a page, JSON and tables.
//
// Differences are a group's mean minus the first group's. Bands and intervals are bootstrapped over
// strides, or over results where these are of several people or days
// (metrics/statistics/mean_difference.h). The smallest difference that exceeds the scatter of
// strides and the tracker's own uncertainty together is the minimal detectable change, t
// sqrt(SEM_a^2 + SEM_b^2), where SEM^2 of a group = SD^2 / n over its strides + (SD by the results'
// own bands)^2 / number of results, and t is Student's at 97.5 % (1.96 with many strides) with the
// degrees of freedom that Welch gives the strides.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace walktrack {
inline namespace jobs {

struct CompareGroup {
  std::string name;                           // "" = the name of its folder
  std::vector<std::filesystem::path> places;  // results, or folders with results below them
};

enum class CompareUnit { kStrides, kTrials };  // the unit of resampling: strides, or results

struct CompareJob {
  std::vector<CompareGroup> groups;  // for one group, its left side is compared with its right side
  std::filesystem::path output;
  CompareUnit unit = CompareUnit::kStrides;
  size_t draws = 2000;
  uint64_t seed = 1;
  bool overwrite = false;
};

struct CompareOutcome {
  size_t compared = 0;   // parameters with a minimal detectable change
  size_t exceeding = 0;  // those that differ by more
  std::filesystem::path look_at;
};

// Parses "PATH", or "NAME=PATH[,PATH...]" if no such path exists.
CompareGroup compare_group(const std::string& word);

// Throws an InputError for places without a complete result and for groups without a whole stride;
// a UsageError for an output that may not be overwritten and for groups with equal names.
CompareOutcome compare(const CompareJob& job);

}  // namespace jobs
}  // namespace walktrack
