#include "io/drawing/error_plot.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "io/drawing/svg.h"

namespace walktrack {
inline namespace io {

namespace {

// In pixels. The two panels are one above the other; the names of the estimates are between the
// title and the curves.
constexpr double kWidth = 900, kLeft = 60, kRight = 880, kLegendLine = 18, kTop = 44;
constexpr double kPanel = 220, kBetween = 64, kBottom = 76;
constexpr double kBarShare = 0.8;  // share of the width for a joint

// An axis from zero to the first round error at or above `most`.
SvgAxis error_axis(double most, double top) {
  const double high = most > 0 ? most : 1, step = tick_step(high);
  return {0, std::ceil(high / step) * step, top + kPanel, top};
}

// Horizontal lines at round errors, from zero up.
std::string error_grid(const SvgAxis& error, const std::string& label) {
  std::string out;
  const double step = tick_step(error.high);
  for (int i = 0; i * step <= error.high * (1 + 1e-9); ++i) {
    const double y = error(i * step);
    out += fmt::format(
        "<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{2:.1f}\" y2=\"{1:.1f}\" stroke=\"#ccc\"/>\n",
        kLeft, y, kRight);
    out += svg_text(kLeft - 6, y + 4, "end", fmt::format("{:g}", i * step));
  }
  return out + svg_text(kLeft, error.to_px - 8, "start", label);
}

std::string time_ticks(const SvgAxis& time, double y) {
  std::string out;
  const double step = tick_step(time.high - time.low);
  for (double t = std::ceil(time.low / step) * step; t <= time.high + 1e-9; t += step)
    out += svg_text(time(t), y + 16, "middle", fmt::format("{:g} s", t));
  return out;
}

// One stroke for each run of known errors without a gap.
std::string curve(const ErrorSeries& series, const SvgAxis& time, const SvgAxis& error,
                  std::string_view stroke) {
  std::string path;
  bool drawing = false;
  for (size_t i = 0; i < series.time.size(); ++i) {
    const bool known = std::isfinite(series.error_mm[i]);
    if (known)
      path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", time(series.time[i]),
                          error(series.error_mm[i]));
    drawing = known;
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"/>\n", path,
                     stroke);
}

std::string curves(const std::vector<ErrorSeries>& all, double top) {
  double first = 0, last = 0, most = 0;
  bool any = false;
  for (const ErrorSeries& series : all) {
    if (series.time.empty()) continue;
    first = any ? std::min(first, series.time.front()) : series.time.front();
    last = any ? std::max(last, series.time.back()) : series.time.back();
    any = true;
    for (const double error : series.error_mm)
      if (std::isfinite(error)) most = std::max(most, error);
  }
  if (last == first) last = first + 1;
  const SvgAxis time{first, last, kLeft, kRight}, error = error_axis(most, top);
  std::string out = error_grid(error, "mean error of pelvis, hips, knees and ankles, mm") +
                    time_ticks(time, top + kPanel);
  for (size_t i = 0; i < all.size(); ++i) out += curve(all[i], time, error, svg_colour(i));
  return out;
}

std::vector<size_t> known_joints(const std::vector<ErrorSeries>& all) {
  std::vector<size_t> out;
  for (size_t j = 0; j < kJointCount; ++j)
    if (std::any_of(all.begin(), all.end(),
                    [j](const ErrorSeries& series) { return std::isfinite(series.joint_mm[j]); }))
      out.push_back(j);
  return out;
}

std::string bars(const std::vector<ErrorSeries>& all, double top) {
  const std::vector<size_t> joints = known_joints(all);
  double most = 0;
  for (const ErrorSeries& series : all)
    for (const size_t j : joints) most = std::fmax(most, series.joint_mm[j]);
  const SvgAxis error = error_axis(most, top);
  std::string out = error_grid(error, "mean error of each joint, mm");
  const double room = (kRight - kLeft) / static_cast<double>(std::max<size_t>(1, joints.size()));
  const double width = kBarShare * room / static_cast<double>(all.size());
  for (size_t k = 0; k < joints.size(); ++k) {
    const double left = kLeft + (static_cast<double>(k) + 0.5 * (1 - kBarShare)) * room;
    const double middle = kLeft + (static_cast<double>(k) + 0.5) * room, below = top + kPanel + 10;
    out += fmt::format(
        "<text transform=\"translate({:.1f} {:.1f}) rotate(-40)\" text-anchor=\"end\">{}</text>\n",
        middle + 4, below, kJointNames[joints[k]]);
    for (size_t i = 0; i < all.size(); ++i) {
      const double value = all[i].joint_mm[joints[k]];
      if (!std::isfinite(value)) continue;
      out += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
          left + static_cast<double>(i) * width, error(value), width, error(0) - error(value),
          svg_colour(i));
    }
  }
  return out;
}

// A square: the share of the truth that an interval holds against the share that it should hold.
// Below the diagonal intervals are too narrow.
std::string reliability(const std::vector<ErrorSeries>& all, double top) {
  const SvgAxis stated{0, 100, kLeft, kLeft + kPanel}, held{0, 100, top + kPanel, top};
  std::string out = error_grid(held, "truth inside the interval, %");
  for (int percent = 0; percent <= 100; percent += 20)
    out += svg_text(stated(percent), top + kPanel + 16, "middle", fmt::format("{}", percent));
  out += svg_text(stated(50), top + kPanel + 34, "middle", "stated, %");
  const auto line = [&](double to, double height, const std::string& path,
                        std::string_view stroke) {
    return fmt::format(
        "<path d=\"M{:.1f} {:.1f}{}L{:.1f} {:.1f}\" fill=\"none\" stroke=\"{}\" "
        "stroke-width=\"1.8\"/>\n",
        stated(0), held(0), path, stated(to), held(height), stroke);
  };
  out += line(100, 100, "", "#999");
  for (size_t i = 0; i < all.size(); ++i) {
    if (!all[i].coverage) continue;
    std::string path;
    for (size_t k = 0; k < kIntervalLevels.size(); ++k)
      path += fmt::format("L{:.1f} {:.1f}", stated(100 * kIntervalLevels[k]),
                          held(100 * all[i].coverage->share_of_level[k]));
    out += line(100, 100, path, svg_colour(i));
  }
  return out;
}

std::string legend(const std::vector<ErrorSeries>& all) {
  std::string out;
  for (size_t i = 0; i < all.size(); ++i) {
    const double y = kTop + static_cast<double>(i) * kLegendLine;
    out += fmt::format("<rect x=\"{}\" y=\"{:.1f}\" width=\"12\" height=\"12\" fill=\"{}\"/>\n",
                       kLeft, y - 10, svg_colour(i));
    out += svg_text(kLeft + 18, y, "start", all[i].name);
  }
  return out;
}

}  // namespace

std::string error_plot_svg(const std::string& title, const std::vector<ErrorSeries>& all) {
  const double first = kTop + static_cast<double>(all.size()) * kLegendLine + 20;
  const double second = first + kPanel + kBetween, third = second + kPanel + kBottom;
  const bool intervals = std::any_of(all.begin(), all.end(), [](const ErrorSeries& series) {
    return series.coverage.has_value();
  });
  const double height = intervals ? third + kPanel + kBetween : third;
  return svg_picture(kWidth, height, kLeft, title,
                     legend(all) + curves(all, first) + bars(all, second) +
                         (intervals ? reliability(all, third) : ""));
}

}  // namespace io
}  // namespace walktrack
