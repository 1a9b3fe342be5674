#include "observation/flow.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace walktrack {

namespace {

using Eigen::Vector2d;

// Pixels around the area that the flow may draw on: a foot swings this far between frames.
constexpr int kMargin = 24;
// The smallest image that the coarse-to-fine search can work on.
constexpr int kSmallestSide = 32;

// Sums over the pixels of one cell.
struct CellSums {
  double gxx = 0, gxy = 0, gyy = 0, miss = 0, u = 0, v = 0;
  int pixels = 0;
};

struct FlowImages {
  cv::Mat gradient_x, gradient_y;  // grey levels per px
  cv::Mat flow;                    // to the frame before
  cv::Mat miss;                    // |now - before moved by the flow|, grey levels
};

FlowImages flow_images(const cv::Mat& before, const cv::Mat& now) {
  FlowImages out;
  cv::Sobel(now, out.gradient_x, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(now, out.gradient_y, CV_32F, 0, 1, 3, 1.0 / 8);
  const auto search = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM);
  search->setVariationalRefinementIterations(0);
  search->calc(now, before, out.flow);
  cv::Mat where(out.flow.size(), CV_32FC2), moved;
  for (int y = 0; y < where.rows; ++y) {
    for (int x = 0; x < where.cols; ++x) {
      const cv::Vec2f& step = out.flow.at<cv::Vec2f>(y, x);
      where.at<cv::Vec2f>(y, x) = {static_cast<float>(x) + step[0],
                                   static_cast<float>(y) + step[1]};
    }
  }
  cv::remap(before, moved, where, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::absdiff(now, moved, out.miss);
  return out;
}

CellSums sum_cell(const FlowImages& images, const cv::Rect& cell) {
  CellSums s;
  for (int y = cell.y; y < cell.y + cell.height; ++y) {
    for (int x = cell.x; x < cell.x + cell.width; ++x) {
      const double gx = images.gradient_x.at<float>(y, x), gy = images.gradient_y.at<float>(y, x);
      s.gxx += gx * gx;
      s.gxy += gx * gy;
      s.gyy += gy * gy;
      s.miss += images.miss.at<uint8_t>(y, x);
      s.u += images.flow.at<cv::Vec2f>(y, x)[0];
      s.v += images.flow.at<cv::Vec2f>(y, x)[1];
      ++s.pixels;
    }
  }
  return s;
}

// With mean structure tensor T = sum l_k q_k q_k', precision = sum q_k q_k' / (s^2 + n^2 / l_k):
// s the error of a well textured patch, n the noise that texture competes with.
FlowSample sample_from(const FlowConfig& config, const CellSums& sums) {
  const double n = sums.pixels;
  const double dx = -sums.u / n, dy = -sums.v / n;
  const double a = sums.gxx / n, b = sums.gxy / n, c = sums.gyy / n;
  const double s2 = config.error_px * config.error_px +
                    config.error_share * config.error_share * (dx * dx + dy * dy);
  const double miss = sums.miss / n, noise2 = config.noise * config.noise + miss * miss;
  const double mean = 0.5 * (a + c), half = std::hypot(0.5 * (a - c), b);
  const auto precision = [&](double texture) { return texture / (s2 * texture + noise2); };
  const double strong = precision(mean + half), weak = precision(std::max(0.0, mean - half));
  // q q' of the strong direction, from the double angle.
  const double cosine = half > 0 ? 0.5 * (a - c) / half : 0, sine = half > 0 ? b / half : 0;
  const double middle = 0.5 * (strong + weak), spread = 0.5 * (strong - weak);
  return {static_cast<float>(dx), static_cast<float>(dy),
          static_cast<float>(middle + spread * cosine), static_cast<float>(spread * sine),
          static_cast<float>(middle - spread * cosine)};
}

// A capsule with what asking about many points needs.
struct Shape {
  Vector2d foot, axis, aside;  // lower centre; to the upper centre; unit vector across
  double radius, grow;         // at the foot; more at the other end
  double inverse_curvature;    // see inside() of capsules.cpp; huge when one disc holds the other
};

// Sends the nearest disc of covers() to the larger end.
constexpr double kOneDisc = 1e30;

Shape shape_of(const Capsule& capsule) {
  const Vector2d axis = capsule.upper.centre - capsule.lower.centre;
  const double grow = capsule.upper.radius - capsule.lower.radius;
  const double curvature = axis.squaredNorm() - grow * grow;
  return {capsule.lower.centre, axis, Vector2d(-axis.y(), axis.x()) / (axis.norm() + 1e-9),
          capsule.lower.radius, grow, curvature > 0 ? 1 / curvature : kOneDisc};
}

bool covers(const Shape& shape, const Vector2d& point) {
  const Vector2d p = point - shape.foot;
  const double t = std::clamp(
      (p.dot(shape.axis) + shape.radius * shape.grow) * shape.inverse_curvature, 0.0, 1.0);
  const double radius = shape.radius + t * shape.grow;
  return (p - t * shape.axis).squaredNorm() <= radius * radius;
}

// The point a share `along` of the axis, moved aside by a share `aside` of the radius there.
Vector2d material_point(const Shape& shape, double along, double aside) {
  return shape.foot + along * shape.axis +
         aside * (shape.radius + along * shape.grow) * shape.aside;
}

// Student-t densities differ by a power of this.
double point_ratio(const FlowConfig& config, const FlowSample& flow, const Vector2d& motion) {
  const auto squared = [&](double x, double y) {
    return static_cast<double>(flow.lxx) * x * x + 2 * static_cast<double>(flow.lxy) * x * y +
           static_cast<double>(flow.lyy) * y * y;
  };
  const double dx = flow.dx, dy = flow.dy;
  const double moving = squared(dx - motion.x(), dy - motion.y()), resting = squared(dx, dy);
  return (config.dof + moving) / (config.dof + resting);
}

// Points of a capsule: three along the axis times two beside it, a quarter of the width each.
constexpr double kAlong[] = {1.0 / 6, 0.5, 5.0 / 6};
constexpr double kAside[] = {-0.5, 0.5};

// The box around a shape, px.
struct Box {
  Vector2d low, high;
};

Box box_of(const Shape& shape) {
  const double radius = shape.radius + std::max(0.0, shape.grow);
  const Vector2d end = shape.foot + shape.axis, reach(radius, radius);
  return {shape.foot.cwiseMin(end) - reach, shape.foot.cwiseMax(end) + reach};
}

bool meet(const Box& a, const Box& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

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
  double ratio = 1;  // of six points at most: far from overflow
  for (const double along : kAlong) {
    for (const double aside : kAside) {
      const Vector2d point = material_point(own, along, aside);
      const FlowSample* const measured = flow.at(point.x(), point.y());
      if (!measured) continue;
      if (hidden(hiders, point)) continue;
      ratio *= point_ratio(config, *measured, point - material_point(before, along, aside));
    }
  }
  const double area = own.axis.norm() * (2 * own.radius + own.grow);
  return -0.5 * (config.dof + 2) * std::log(ratio) * area /
         static_cast<double>(std::size(kAlong) * std::size(kAside));
}

}  // namespace

void measure_flow(const FlowConfig& config, const cv::Mat& before, const cv::Mat& now,
                  const PixelRect& area, FlowField& out) {
  out.area = area;
  out.step = config.step_px;
  out.columns = (area.width() + out.step - 1) / out.step;
  out.rows = (area.height() + out.step - 1) / out.step;
  out.samples.clear();
  const cv::Rect padded = cv::Rect(area.x0 - kMargin, area.y0 - kMargin, area.width() + 2 * kMargin,
                                   area.height() + 2 * kMargin) &
                          cv::Rect(0, 0, now.cols, now.rows);
  if (area.empty() || std::min(padded.width, padded.height) < kSmallestSide) {
    out.columns = out.rows = 0;
    return;
  }
  const FlowImages images = flow_images(before(padded).clone(), now(padded).clone());
  for (int j = 0; j < out.rows; ++j) {
    for (int i = 0; i < out.columns; ++i) {
      const cv::Rect cell(area.x0 + i * out.step - padded.x, area.y0 + j * out.step - padded.y,
                          out.step, out.step);
      const cv::Rect in_image = cell & cv::Rect(0, 0, padded.width, padded.height);
      out.samples.push_back(sample_from(config, sum_cell(images, in_image)));
    }
  }
}

double flow_log_ratio(const FlowConfig& config, const FlowField& flow, const CapsuleList& now,
                      const CapsuleList& before) {
  if (flow.samples.empty()) return 0;
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
