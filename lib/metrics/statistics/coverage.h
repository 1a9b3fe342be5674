// How often stated intervals contain the truth.
#pragma once

#include <array>
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

struct Coverage {
  size_t count = 0;       // joint coordinates compared
  double share = 0;       // of them inside [p05, p95]
  double mean_width = 0;  // of the intervals, m
};

struct CoverageReport {
  Coverage scored;  // the seven scored joints together
  std::array<Coverage, kJointCount> by_joint;
};

// Compares at the truth's rows that have an uncertainty row at the same instant.
CoverageReport coverage(const Motion& truth, const JointUncertainty& uncertainty);

}  // namespace metrics
}  // namespace walktrack
