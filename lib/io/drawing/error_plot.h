// A plot of the errors of several estimates against one truth: over time, for each joint, and how
// often stated intervals contain the truth.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "body/pose.h"
#include "metrics/statistics/coverage.h"

namespace walktrack {
inline namespace io {

struct ErrorSeries {
  std::string name;                          // of the estimate
  std::vector<double> time;                  // s
  std::vector<double> error_mm;              // at these times; NaN = the subject was not tracked
  std::array<double, kJointCount> joint_mm;  // mean; NaN = never known
  std::optional<Coverage> coverage;          // of its intervals, if it has some
};

// A self-contained SVG: curves above, bars below, then the reliability diagram of the estimates
// that have intervals, a colour for each estimate.
std::string error_plot_svg(const std::string& title, const std::vector<ErrorSeries>& all);

}  // namespace io
}  // namespace walktrack
