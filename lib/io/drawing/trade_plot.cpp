#include "io/drawing/trade_plot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/drawing/svg.h"

namespace walktrack {
inline namespace io {

namespace {

// Pixels.
constexpr double kPlotWidth = 760, kPlotLeft = 64, kPlotRight = 740, kPlotTop = 72, kFloor = 432;
constexpr double kLegendTop = 492, kPlotLegendLine = 19, kRadius = 5;
constexpr double kRoom = 1.15;  // margin beyond the outermost points, as a factor of speed
constexpr std::string_view kGrid = "#ccc", kOther = "#888";

std::string line(double x1, double y1, double x2, double y2, std::string_view colour,
                 double width = 1) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
      "stroke-width=\"{}\"/>\n",
      x1, y1, x2, y2, colour, width);
}

struct Axes {
  SvgAxis log_speed, error;
  double x(const TradePoint& p) const { return log_speed(std::log10(p.frames_per_second)); }
  double y(const TradePoint& p) const { return error(p.error_mm); }
};

Axes axes_of(const std::vector<TradePoint>& points) {
  double slowest = 1, fastest = 1, most = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const TradePoint& p = points[i];
    slowest = i == 0 ? p.frames_per_second : std::min(slowest, p.frames_per_second);
    fastest = i == 0 ? p.frames_per_second : std::max(fastest, p.frames_per_second);
    most = std::max(most, p.error_mm + std::fmax(p.error_sd_mm, 0));
  }
  const double high = most > 0 ? most : 1, step = tick_step(high);
  return {{std::log10(slowest / kRoom), std::log10(fastest * kRoom), kPlotLeft, kPlotRight},
          {0, std::ceil(high / step) * step, kFloor, kPlotTop}};
}

std::string error_ticks(const SvgAxis& error) {
  std::string out;
  const double step = tick_step(error.high);
  for (int i = 0; i * step <= error.high * (1 + 1e-9); ++i) {
    const double y = error(i * step);
    out += line(kPlotLeft, y, kPlotRight, y, kGrid) +
           svg_text(kPlotLeft - 6, y + 4, "end", fmt::format("{:g}", i * step));
  }
  return out;
}

// 1, 2, 5, 10, ... frames/s.
std::string speed_ticks(const SvgAxis& log_speed) {
  std::string out;
  for (int power = -3; power <= 6; ++power) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double speed = digit * std::pow(10, power), x = log_speed(std::log10(speed));
      if (x < kPlotLeft || x > kPlotRight) continue;
      out += line(x, kPlotTop, x, kFloor, kGrid) +
             svg_text(x, kFloor + 18, "middle", fmt::format("{:g}", speed));
    }
  }
  return out + svg_text((kPlotLeft + kPlotRight) / 2, kFloor + 38, "middle", "frames/s");
}

std::string mark(const TradePoint& p, const Axes& axes) {
  const double x = axes.x(p), y = axes.y(p);
  const std::string_view colour = p.on_front ? svg_colour(0) : p.holds ? kOther : svg_colour(1);
  std::string out;
  if (std::isfinite(p.error_sd_mm))
    out += line(x, axes.error(std::max(0.0, p.error_mm - p.error_sd_mm)), x,
                axes.error(p.error_mm + p.error_sd_mm), colour);
  if (!p.holds) {
    return out + line(x - kRadius, y - kRadius, x + kRadius, y + kRadius, colour, 2) +
           line(x - kRadius, y + kRadius, x + kRadius, y - kRadius, colour, 2);
  }
  return out + fmt::format(
                   "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\" stroke=\"{}\" "
                   "stroke-width=\"1.5\"><title>{}</title></circle>\n",
                   x, y, kRadius, p.on_front ? colour : "white", colour, svg_escaped(p.name));
}

std::string front(const std::vector<TradePoint>& sorted, const Axes& axes) {
  std::string path, names;
  int number = 0;
  for (const TradePoint& p : sorted) {
    if (!p.on_front) continue;
    const double x = axes.x(p), y = axes.y(p);
    path += fmt::format("{}{:.1f} {:.1f}", number == 0 ? "M" : "L", x, y);
    ++number;
    names += svg_text(x + kRadius + 3, y - kRadius, "start", fmt::format("{}", number));
    names += svg_text(kPlotLeft, kLegendTop + number * kPlotLegendLine, "start",
                      fmt::format("{}  {}: {:.1f} mm at {:.3g} frames/s", number, p.name,
                                  p.error_mm, p.frames_per_second));
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"/>\n", path,
                     svg_colour(0)) +
         names;
}

}  // namespace

std::string trade_plot_svg(const std::string& title, const std::string& error_is,
                           const std::vector<TradePoint>& points) {
  std::vector<TradePoint> known;
  std::copy_if(points.begin(), points.end(), std::back_inserter(known),
               [](const TradePoint& p) { return std::isfinite(p.error_mm); });
  std::sort(known.begin(), known.end(), [](const TradePoint& a, const TradePoint& b) {
    return a.frames_per_second < b.frames_per_second;
  });
  const Axes axes = axes_of(known);
  std::string out = svg_text(kPlotLeft, kPlotTop - 12, "start", error_is) +
                    error_ticks(axes.error) + speed_ticks(axes.log_speed);
  for (const TradePoint& p : known) out += mark(p, axes);
  out += front(known, axes);
  out += svg_text(kPlotLeft, kLegendTop - 4, "start",
                  "filled: nothing is both faster and better; cross: lost the subject");
  const auto named =
      std::count_if(known.begin(), known.end(), [](const TradePoint& p) { return p.on_front; });
  const double height = kLegendTop + static_cast<double>(named + 1) * kPlotLegendLine;
  return svg_picture(kPlotWidth, height, kPlotLeft, title, out);
}

}  // namespace io
}  // namespace walktrack
