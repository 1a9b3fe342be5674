// A plot of error against speed: the settings of a sweep, and those that no other setting beats.
#pragma once

#include <string>
#include <vector>

namespace walktrack {
inline namespace io {

struct TradePoint {
  std::string name;
  double frames_per_second;      // > 0
  double error_mm, error_sd_mm;  // NaN = not known; a point without an error is left out
  bool holds = true;             // otherwise drawn as a cross
  bool on_front = false;         // numbered, joined by a line and named below the picture
};

// A self-contained SVG; speed is logarithmic, the error begins at zero.
std::string trade_plot_svg(const std::string& title, const std::string& error_is,
                           const std::vector<TradePoint>& points);

}  // namespace io
}  // namespace walktrack
