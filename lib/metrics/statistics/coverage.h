// How often stated intervals contain the true value.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "body/motion.h"

namespace walktrack {
inline namespace metrics {

// uncertainty.csv: for each row and joint coordinate a standard deviation and the 5th and 95th
// percentile, metres. NaN = unknown.
struct JointUncertainty {
  std::vector<double> time;
  std::vector<JointPositions> sd, p05, p95;
};

// Levels of central intervals: how often an interval that is stated to contain the truth in 10, 20,
// ... 90 % of the cases contains it. Intervals are those of the normal distribution with these
// percentiles.
inline constexpr std::array kIntervalLevels{.1, .2, .3, .4, .5, .6, .7, .8, .9};

struct Coverage {
  size_t count = 0;                                             // joint coordinates compared
  double share = 0;                                             // of them inside [p05, p95]
  double mean_width = 0;                                        // of the intervals, m
  std::array<double, kIntervalLevels.size()> share_of_level{};  // of them inside, by level
};

// Expected calibration error: mean over the levels of |share - level| (Kuleshov, Fenner & Ermon,
// ICML 2018, with absolute differences). 0 is calibrated; intervals that always contain the
// truth, or never do, have 0.5.
double calibration_error(const Coverage& coverage);

enum class Direction { kLevel, kUp };  // over the ground, upwards

struct CoverageReport {
  Coverage scored;                                            // the seven scored joints together
  std::array<std::array<Coverage, 2>, kJointCount> by_joint;  // and Direction
  const Coverage& of(Joint joint, Direction direction) const {
    return by_joint[static_cast<size_t>(joint)][static_cast<size_t>(direction)];
  }
};

// Of several together.
Coverage joined(std::span<const Coverage> parts);

// Compares at the truth's rows that have an uncertainty row at the same instant.
CoverageReport coverage(const Motion& truth, const JointUncertainty& uncertainty);

}  // namespace metrics
}  // namespace walktrack
