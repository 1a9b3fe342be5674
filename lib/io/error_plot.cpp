#include "io/error_plot.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace walktrack {

namespace {

// Pixels. Two panels above each other, names of the estimates between title and curves.
constexpr double kWidth = 900, kLeft = 60, kRight = 880, kLegendLine = 18, kTop = 44;
constexpr double kPanel = 220, kBetween = 64, kBottom = 76;
constexpr double kBarShare = 0.8;  // of a joint's room

// Told apart by people who see colours otherwise (Okabe & Ito 2008).
constexpr std::array<std::string_view, 7> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                   "#e69f00", "#56b4e9", "#000000"};

std::string_view colour(size_t series) { return kColours[series % kColours.size()]; }

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else {
      out += c;
    }
  }
  return out;
}

// 1, 2 or 5 times a power of ten, such that about five fit into the range.
double tick_step(double range) {
  const double rough = range / 5, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * power >= rough) return step * power;
  return 10 * power;
}

// A range of values along an edge of a panel.
struct Axis {
  double low, high;       // values
  double from_px, to_px;  // where they are
  double operator()(double value) const {
    return from_px + (value - low) / (high - low) * (to_px - from_px);
  }
};

// From zero to the first round error at or above `most`.
Axis error_axis(double most, double top) {
  const double high = most > 0 ? most : 1, step = tick_step(high);
  return {0, std::ceil(high / step) * step, top + kPanel, top};
}

std::string text_at(double x, double y, std::string_view anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     escaped(text));
}

// Lines across the panel at round errors, from zero up.
std::string error_grid(const Axis& error, const std::string& label) {
  std::string out;
  const double step = tick_step(error.high);
  for (int i = 0; i * step <= error.high * (1 + 1e-9); ++i) {
    const double y = error(i * step);
    out += fmt::format(
        "<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{2:.1f}\" y2=\"{1:.1f}\" stroke=\"#ccc\"/>\n",
        kLeft, y, kRight);
    out += text_at(kLeft - 6, y + 4, "end", fmt::format("{:g}", i * step));
  }
  return out + text_at(kLeft, error.to_px - 8, "start", label);
}

std::string time_ticks(const Axis& time, double y) {
  std::string out;
  const double step = tick_step(time.high - time.low);
  for (double t = std::ceil(time.low / step) * step; t <= time.high + 1e-9; t += step)
    out += text_at(time(t), y + 16, "middle", fmt::format("{:g} s", t));
  return out;
}

// One stroke for each unbroken run of known errors.
std::string curve(const ErrorSeries& series, const Axis& time, const Axis& error,
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
  const Axis time{first, last, kLeft, kRight}, error = error_axis(most, top);
  std::string out = error_grid(error, "mean error of pelvis, hips, knees and ankles, mm") +
                    time_ticks(time, top + kPanel);
  for (size_t i = 0; i < all.size(); ++i) out += curve(all[i], time, error, colour(i));
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
  const Axis error = error_axis(most, top);
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
          colour(i));
    }
  }
  return out;
}

std::string legend(const std::vector<ErrorSeries>& all) {
  std::string out;
  for (size_t i = 0; i < all.size(); ++i) {
    const double y = kTop + static_cast<double>(i) * kLegendLine;
    out += fmt::format("<rect x=\"{}\" y=\"{:.1f}\" width=\"12\" height=\"12\" fill=\"{}\"/>\n",
                       kLeft, y - 10, colour(i));
    out += text_at(kLeft + 18, y, "start", all[i].name);
  }
  return out;
}

}  // namespace

std::string error_plot_svg(const std::string& title, const std::vector<ErrorSeries>& all) {
  const double first = kTop + static_cast<double>(all.size()) * kLegendLine + 20;
  const double second = first + kPanel + kBetween, height = second + kPanel + kBottom;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"13\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      kWidth, height);
  svg += fmt::format("<text x=\"{}\" y=\"20\" font-size=\"16\">{}</text>\n", kLeft, escaped(title));
  return svg + legend(all) + curves(all, first) + bars(all, second) + "</svg>\n";
}

}  // namespace walktrack
