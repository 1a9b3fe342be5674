#include "observation/flow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <opencv2/imgproc.hpp>

#include "observation/flow_points.h"

namespace walktrack {

namespace {

using Eigen::Vector2d;

// Pixels around the area that are kept: a foot swings this far between frames.
constexpr int kMargin = 48;
// Of the smoothing, px: less than a limb's width, enough for a motion that is a pixel off to be
// pulled the right way.
constexpr double kSmoothing = 0.8;

cv::Mat smoothed(const cv::Mat& grey) {
  cv::Mat out;
  grey.convertTo(out, CV_32F);
  cv::GaussianBlur(out, out, {0, 0}, kSmoothing);
  return out;
}

// Student-t densities differ by a power of this. 1 where nothing is known.
double point_ratio(const FlowConfig& config, const FlowField& flow, const Vector2d& is,
                   const Vector2d& was) {
  const auto here = between(flow, is), there = between(flow, was);
  if (!here || !there || there->precision() == 0) return 1;
  const double grey = static_cast<double>(here->mix(&FlowPixel::now));
  const double moving = grey - static_cast<double>(there->mix(&FlowPixel::before));
  const double resting = grey - static_cast<double>(here->mix(&FlowPixel::before));
  const double precision = static_cast<double>(here->precision());
  return (config.dof + precision * moving * moving) / (config.dof + precision * resting * resting);
}

// Points of a capsule: six along the axis times four beside it. With six in all, single pixels
// made the likelihood rugged: 3 cm beside the truth it was as high again.
constexpr double kAlong[] = {1.0 / 12, 3.0 / 12, 5.0 / 12, 7.0 / 12, 9.0 / 12, 11.0 / 12};
constexpr double kAside[] = {-0.75, -0.25, 0.25, 0.75};

// The shapes of a body, nearest first.
struct Shapes {
  size_t count = 0;
  std::array<Shape, kMaxCapsules> shape;
  std::array<Box, kMaxCapsules> box;
};

void add(const Capsule& capsule, Shapes& shapes) {
  shapes.shape[shapes.count] = shape_of(capsule);
  shapes.box[shapes.count] = box_of(shapes.shape[shapes.count]);
  ++shapes.count;
}

struct Hiders {
  size_t count = 0;
  std::array<const Shape*, kMaxCapsules> shape;
};

// The shapes that may hide some of the last one.
Hiders hiders_of_last(const Shapes& shapes) {
  const size_t last = shapes.count - 1;
  Hiders out;
  for (size_t i = 0; i < last; ++i)
    if (meet(shapes.box[i], shapes.box[last])) out.shape[out.count++] = &shapes.shape[i];
  return out;
}

bool hidden(const Hiders& hiders, const Vector2d& point) {
  return std::any_of(hiders.shape.begin(), hiders.shape.begin() + hiders.count,
                     [&](const Shape* shape) { return covers(*shape, point); });
}

// Of the last of `shapes`.
double part_log_ratio(const FlowConfig& config, const FlowField& flow, const Shapes& shapes,
                      const Shape& before) {
  const Shape& own = shapes.shape[shapes.count - 1];
  const Hiders hiders = hiders_of_last(shapes);
  double log_ratio = 0;
  for (const double along : kAlong) {
    double ratio = 1;  // of four points: far from overflow
    for (const double aside : kAside) {
      const Vector2d point = pixel_of(own, {along, aside});
      if (hidden(hiders, point)) continue;
      ratio *= point_ratio(config, flow, point, pixel_of(before, {along, aside}));
    }
    log_ratio += std::log(ratio);
  }
  const double area = own.axis.norm() * (2 * own.radius + own.grow);
  return -0.5 * (config.dof + 1) * log_ratio * area /
         static_cast<double>(std::size(kAlong) * std::size(kAside));
}

}  // namespace

void pair_frames(const FlowConfig& config, const cv::Mat& before, const cv::Mat& now,
                 const PixelRect& area, FlowField& out) {
  out.pixels.clear();
  out.area = {};
  if (area.empty()) return;
  out.area =
      intersection({area.x0 - kMargin, area.y0 - kMargin, area.x1 + kMargin, area.y1 + kMargin},
                   {0, 0, now.cols, now.rows});
  const cv::Rect cut(out.area.x0, out.area.y0, out.area.width(), out.area.height());
  const cv::Mat present = smoothed(now(cut)), past = smoothed(before(cut));
  cv::Mat gradient_x, gradient_y;  // grey levels per px
  cv::Sobel(present, gradient_x, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(present, gradient_y, CV_32F, 0, 1, 3, 1.0 / 8);
  const auto noise2 = static_cast<float>(config.noise * config.noise);
  const auto error2 = static_cast<float>(config.error_px * config.error_px);
  for (int y = 0; y < cut.height; ++y) {
    for (int x = 0; x < cut.width; ++x) {
      const float gx = gradient_x.at<float>(y, x), gy = gradient_y.at<float>(y, x);
      out.pixels.push_back({present.at<float>(y, x), past.at<float>(y, x),
                            1 / (noise2 + error2 * (gx * gx + gy * gy))});
    }
  }
}

void pair_frames(const FlowConfig& config, const GreyImage& before, const GreyImage& now,
                 const PixelRect& area, FlowField& out) {
  // OpenCV has no view of constant pixels.
  const auto view = [](const GreyImage& image) {
    return cv::Mat(image.height, image.width, CV_8U, const_cast<uint8_t*>(image.pixels.data()));
  };
  pair_frames(config, view(before), view(now), area, out);
}

double flow_log_ratio(const FlowConfig& config, const FlowField& flow, const CapsuleList& now,
                      const CapsuleList& before) {
  if (flow.pixels.empty()) return 0;
  Shapes shapes;
  std::array<const Capsule*, kMaxCapsules> earlier{};
  for (const Capsule& capsule : before) earlier[static_cast<size_t>(capsule.part)] = &capsule;
  double sum = 0;
  for (size_t i = 0; i < now.size(); ++i) {
    add(now[i], shapes);
    const Capsule* const was = earlier[static_cast<size_t>(now[i].part)];
    if (was) sum += part_log_ratio(config, flow, shapes, shape_of(*was));
  }
  return sum;
}

}  // namespace walktrack
