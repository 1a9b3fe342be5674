#include "io/drawing/overlay_view.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <opencv2/imgproc.hpp>

#include "body/motion.h"

namespace walktrack {
inline namespace io {

namespace {

using Eigen::Array2d;
using Eigen::Vector2d;

constexpr int kLeastSide = 32;     // px; the smallest side that encoders accept
constexpr int kLeastHeight = 480;  // px; windows are enlarged to at least this height
constexpr double kMargin = 0.15;   // share of a window's sides, added around the joints for head,
                                   // hands and feet

int even(double length) { return std::max(kLeastSide, 2 * static_cast<int>(length / 2)); }

cv::Size size_at(const cv::Size& area, double scale) {
  return {even(std::round(scale * area.width)), even(std::round(scale * area.height))};
}

double shrinking_to(int width_px, double wide) {
  return width_px > 0 ? std::min(1.0, width_px / wide) : 1.0;
}

// Distances from the pelvis to the bounding box of the joints, px: to its upper left and to its
// lower right corner.
struct PixelReach {
  Vector2d pelvis;
  Array2d before{0, 0}, after{0, 0};
};

// Only joints near the image are counted; lens models are not valid far outside.
std::optional<PixelReach> reach_of(const Camera& camera, const JointPositions& joints) {
  const Array2d size(camera.width_px, camera.height_px);
  const auto pixel = [&](const Eigen::Vector3d& joint) -> std::optional<Vector2d> {
    if (!known(joint)) return std::nullopt;
    const auto px = project(camera, joint);
    const bool near = px && ((px->array() > -size) && (px->array() < 2 * size)).all();
    return near ? px : std::nullopt;
  };
  const auto pelvis = pixel(joints[Joint::kPelvis]);
  if (!pelvis) return std::nullopt;
  PixelReach out{*pelvis};
  for (const Eigen::Vector3d& joint : joints.at) {
    const auto px = pixel(joint);
    if (!px) continue;
    out.before = out.before.max((*pelvis - *px).array());
    out.after = out.after.max((*px - *pelvis).array());
  }
  const Array2d first = pelvis->array() - out.before, last = pelvis->array() + out.after;
  const bool in_picture = (last > 0).all() && (first < size).all();
  return in_picture ? std::optional(out) : std::nullopt;
}

// The pelvis in every frame, interpolated linearly between frames in which it is known.
std::vector<Vector2d> filled(const std::vector<std::optional<PixelReach>>& reaches) {
  std::vector<Vector2d> out(reaches.size());
  std::optional<size_t> before;
  for (size_t i = 0; i < reaches.size(); ++i) {
    if (!reaches[i]) continue;
    out[i] = reaches[i]->pelvis;
    const size_t from = before ? *before : 0;
    const Vector2d start = before ? out[from] : out[i];
    for (size_t k = before ? from + 1 : 0; k < i; ++k)
      out[k] = start + double(k - from) / double(i - from) * (out[i] - start);
    before = i;
  }
  for (size_t k = before.value_or(0) + 1; before && k < out.size(); ++k) out[k] = out[*before];
  return out;
}

cv::Rect inside(const Camera& camera, const Array2d& corner, const cv::Size& size) {
  const auto place = [](double wanted, int length, int whole) {
    return std::clamp(static_cast<int>(std::lround(wanted)), 0, whole - length);
  };
  return {place(corner.x(), size.width, camera.width_px),
          place(corner.y(), size.height, camera.height_px), size.width, size.height};
}

Array2d ratio_of(const OverlayView& view) {
  return Array2d(view.size.width, view.size.height) / Array2d(view.area.width, view.area.height);
}

// The largest factor by which the area can be shrunk without a remainder and stays large enough.
int whole_factor(const OverlayView& view) {
  const cv::Rect& area = view.area;
  int factor = std::max(1, std::min(area.width / view.size.width, area.height / view.size.height));
  while (area.width % factor != 0 || area.height % factor != 0) --factor;
  return factor;
}

}  // namespace

OverlayView whole_view(const Camera& camera, int width_px) {
  const cv::Size size(camera.width_px, camera.height_px);
  return {{{0, 0}, size}, size_at(size, shrinking_to(width_px, size.width))};
}

std::vector<OverlayView> views_around(const Camera& camera, std::span<const JointPositions> frames,
                                      int width_px) {
  std::vector<std::optional<PixelReach>> reaches;
  Array2d before(0, 0), after(0, 0);
  for (const JointPositions& joints : frames) {
    const auto& reach = reaches.emplace_back(reach_of(camera, joints));
    if (!reach) continue;
    before = before.max(reach->before);
    after = after.max(reach->after);
  }
  const Array2d joints = before + after;
  if (joints.isZero()) return {frames.size(), whole_view(camera, width_px)};
  const Array2d margin = kMargin * Array2d::Constant(joints.maxCoeff());
  const Array2d wanted = (joints + 2 * margin).ceil();
  const cv::Size area(static_cast<int>(std::min<double>(wanted.x(), camera.width_px)),
                      static_cast<int>(std::min<double>(wanted.y(), camera.height_px)));
  const double enlarging = std::max(1.0, double(kLeastHeight) / area.height);
  const double at_most = width_px > 0 ? double(width_px) / area.width : enlarging;
  const cv::Size size = size_at(area, std::min(enlarging, at_most));
  std::vector<OverlayView> out;
  for (const Vector2d& pelvis : filled(reaches))
    out.push_back({inside(camera, pelvis.array() - before - margin, area), size});
  return out;
}

Camera camera_of(const OverlayView& view, const Camera& camera) {
  Camera out = camera;
  out.width_px = view.size.width;
  out.height_px = view.size.height;
  out.focal_px = ratio_of(view).matrix().cwiseProduct(camera.focal_px);
  out.centre_px = in_view(view, camera.centre_px);
  return out;
}

Vector2d in_view(const OverlayView& view, const Vector2d& px) {
  return ratio_of(view) * (px.array() - Array2d(view.area.x, view.area.y) + 0.5) - 0.5;
}

void look_through(const OverlayView& view, const FrameSource& video, cv::Mat& out) {
  const int factor = whole_factor(view);
  if (view.area.size() == view.size * factor) return video.picture(view.area, factor, out);
  cv::Mat seen;
  video.picture(view.area, factor, seen);
  const bool twice = seen.cols >= 2 * view.size.width || seen.rows >= 2 * view.size.height;
  cv::resize(seen, out, view.size, 0, 0, twice ? cv::INTER_AREA : cv::INTER_LINEAR);
}

}  // namespace io
}  // namespace walktrack
