// The errors of estimates against one truth as a picture: over time, and of each joint.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "body/pose.h"

namespace walktrack {
inline namespace io {

struct ErrorSeries {
  std::string name;                          // of the estimate
  std::vector<double> time;                  // s
  std::vector<double> error_mm;              // at these times; NaN = the walker was not there
  std::array<double, kJointCount> joint_mm;  // mean; NaN = never known
};

// A self-contained SVG: curves above, bars below, a colour for each estimate.
std::string error_plot_svg(const std::string& title, const std::vector<ErrorSeries>& all);

}  // namespace io
}  // namespace walktrack
