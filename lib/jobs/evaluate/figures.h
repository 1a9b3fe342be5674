// The errors of an estimate, as named numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "body/motion.h"
#include "jobs/evaluate/truth.h"
#include "kinetics/force_error.h"
#include "metrics/statistics/coverage.h"

namespace walktrack {
inline namespace jobs {

struct Figure {
  std::string key;    // with its unit, e.g. "joint_error_mean_mm"
  std::string label;  // its description
  double value;       // NaN = unknown
  int decimals;
  bool detail = false;  // not in the text table
};

// All errors that this truth can tell about the estimate, in a fixed order of keys.
std::vector<Figure> figures(const Truth& truth, const Motion& estimate,
                            const std::optional<JointUncertainty>& uncertainty);

// Errors of ground reactions (kinetics/force_error.h).
std::vector<Figure> force_figures(const GroundForces& truth, const GroundForces& estimate);

}  // namespace jobs
}  // namespace walktrack
