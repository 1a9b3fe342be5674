#include "io/drawing/stick_figure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "io/drawing/sub_pixel.h"
#include "io/video/video_writer.h"

namespace walktrack {
inline namespace io {
namespace {

using Eigen::Vector2d;

constexpr double kFigurePx = 220;  // height of the tallest figure
constexpr double kPitchPx = 150;   // distance between the figures of a strip
constexpr double kMarginPx = 50;

struct LineColour {
  int red, green, blue;
};
constexpr std::array kGroupColours{LineColour{40, 40, 40}, LineColour{200, 60, 40},
                                   LineColour{40, 90, 200}};
constexpr LineColour kGround{150, 150, 150};

const LineColour& colour_of(int group) { return kGroupColours[static_cast<size_t>(group) % 3]; }

// A line in pixels, x right, y down.
struct Drawn {
  Vector2d from, to;
  LineColour colour;
  double width;
};

// Converts metres to pixels around the point (x, 0). The ground falls to the right if the slope is
// positive.
class View {
 public:
  View(double x, double slope, double scale, Vector2d origin_px)
      : x_(x), c_(std::cos(slope)), s_(std::sin(slope)), scale_(scale), origin_px_(origin_px) {}
  Vector2d operator()(const Vector2d& p) const {
    const double x = p.x() - x_, z = p.y();
    return origin_px_ + scale_ * Vector2d(c_ * x + s_ * z, s_ * x - c_ * z);
  }

 private:
  double x_, c_, s_, scale_;
  Vector2d origin_px_;
};

double tallest(const std::vector<StickFigure>& figures) {
  double height = 1e-6;
  for (const StickFigure& figure : figures) {
    for (const StickLine& line : figure.lines) {
      height = std::max({height, line.from.y(), line.to.y()});
    }
  }
  return height;
}

// Distance between marks on the ground, m: 0.5, or the first of 5, 50, 500 ... for which they are
// at least 20 pixels apart.
double mark_spacing(double scale) {
  double spacing = 0.5;
  while (spacing * scale < 20) spacing *= 10;
  return spacing;
}

void add_figure(const StickFigure& figure, const View& view, std::vector<Drawn>& drawn) {
  for (const StickLine& line : figure.lines) {
    drawn.push_back({view(line.from), view(line.to), colour_of(line.group), 3});
  }
}

struct Strip {
  double width_px, height_px;
  std::vector<Drawn> lines;
  std::vector<std::pair<Vector2d, std::string>> labels;
};

Strip laid_out(const std::vector<StickFigure>& figures, double slope) {
  Strip strip{2 * kMarginPx + kPitchPx * static_cast<double>(figures.size()),
              2 * kMarginPx + kFigurePx,
              {},
              {}};
  const double scale = kFigurePx / tallest(figures);
  for (size_t i = 0; i < figures.size(); ++i) {
    const Vector2d origin(kMarginPx + kPitchPx * (static_cast<double>(i) + 0.5),
                          kMarginPx + kFigurePx);
    const View view(figures[i].x, slope, scale, origin);
    const double half = 0.45 * kPitchPx / scale;
    strip.lines.push_back(
        {view({figures[i].x - half, 0}), view({figures[i].x + half, 0}), kGround, 1});
    add_figure(figures[i], view, strip.lines);
    strip.labels.emplace_back(origin + Vector2d(-24, 36), fmt::format("{:.2f} s", figures[i].time));
  }
  return strip;
}

cv::Scalar bgr(const LineColour& colour) {
  return {static_cast<double>(colour.blue), static_cast<double>(colour.green),
          static_cast<double>(colour.red)};
}

void draw(const std::vector<Drawn>& lines, cv::Mat& image) {
  for (const Drawn& line : lines) {
    cv::line(image, fixed_point(line.from), fixed_point(line.to), bgr(line.colour),
             static_cast<int>(line.width), cv::LINE_AA, kFractionBits);
  }
}

void write_text(cv::Mat& image, const Vector2d& at, const std::string& text) {
  cv::putText(image, text, {static_cast<int>(at.x()), static_cast<int>(at.y())},
              cv::FONT_HERSHEY_SIMPLEX, 0.5, bgr(kGroupColours[0]), 1, cv::LINE_AA);
}

}  // namespace

std::string strip_as_svg(const std::vector<StickFigure>& figures, double slope) {
  const Strip strip = laid_out(figures, slope);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      strip.width_px, strip.height_px);
  for (const Drawn& line : strip.lines) {
    svg += fmt::format(
        "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" "
        "stroke=\"rgb({},{},{})\" stroke-width=\"{:g}\" stroke-linecap=\"round\"/>\n",
        line.from.x(), line.from.y(), line.to.x(), line.to.y(), line.colour.red, line.colour.green,
        line.colour.blue, line.width);
  }
  for (const auto& [at, text] : strip.labels) {
    svg += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" font-family=\"sans-serif\" font-size=\"14\">{}</text>\n",
        at.x(), at.y(), text);
  }
  return svg + "</svg>\n";
}

cv::Mat strip_as_image(const std::vector<StickFigure>& figures, double slope) {
  const Strip strip = laid_out(figures, slope);
  cv::Mat image(static_cast<int>(strip.height_px), static_cast<int>(strip.width_px), CV_8UC3,
                cv::Scalar::all(255));
  draw(strip.lines, image);
  for (const auto& [at, text] : strip.labels) write_text(image, at, text);
  return image;
}

void write_animation(const std::filesystem::path& path, const std::vector<StickFigure>& figures,
                     double slope, double frame_rate) {
  constexpr int kWidth = 640, kHeight = 360;
  const double scale = kFigurePx / tallest(figures);
  const double half = kWidth / scale, mark_every = mark_spacing(scale);
  VideoWriter writer(path, {kWidth, kHeight}, frame_rate);
  for (const StickFigure& figure : figures) {
    cv::Mat image(kHeight, kWidth, CV_8UC3, cv::Scalar::all(255));
    const View view(figure.x, slope, scale, {kWidth / 2.0, kMarginPx + kFigurePx});
    std::vector<Drawn> drawn{{view({figure.x - half, 0}), view({figure.x + half, 0}), kGround, 2}};
    const double first = std::ceil((figure.x - half) / mark_every) * mark_every;
    for (double mark = first; mark < figure.x + half; mark += mark_every) {
      drawn.push_back({view({mark, 0}), view({mark, -10 / scale}), kGround, 2});
    }
    add_figure(figure, view, drawn);
    draw(drawn, image);
    write_text(image, {kMarginPx / 2, kHeight - kMarginPx / 2},
               fmt::format("{:.2f} s", figure.time));
    writer.write(image);
  }
  writer.close();
}

}  // namespace io
}  // namespace walktrack
