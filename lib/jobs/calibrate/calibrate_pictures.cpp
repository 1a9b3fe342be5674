#include "jobs/calibrate/calibrate_pictures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/drawing/overlay.h"
#include "io/drawing/picture.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr double kEnlargement = 30;                         // of residuals in the image of the lens
const ImageColour kFound(80, 220, 80), kMiss(60, 60, 255);  // green, red

void draw_thick_cross(Image& image, const Eigen::Vector2d& at, double half,
                      const ImageColour& colour) {
  draw_stroke(image, at - Eigen::Vector2d(half, 0), at + Eigen::Vector2d(half, 0), colour);
  draw_stroke(image, at - Eigen::Vector2d(0, half), at + Eigen::Vector2d(0, half), colour);
}

}  // namespace

Image lens_picture(const BoardViews& views, const LensFit& fit) {
  Image image = dimmed(views.picture, 0.4);
  for (size_t v = 0; v < views.points.size(); ++v) {
    for (size_t i = 0; i < views.points[v].size(); ++i) {
      const Eigen::Vector2d& at = views.points[v][i];
      draw_ring(image, at, 1, kFound);
      draw_stroke(image, at, at - kEnlargement * fit.misses[v][i], kMiss);
    }
  }
  draw_caption(image, fmt::format("{} views: green found, red error x{:.0f}; rms {:.2f} px",
                                  views.points.size(), kEnlargement, fit.rms_px));
  return image;
}

Image place_picture(const Image& picture, const PlaceFit& fit, const MeasuredPoints& points) {
  Image image = picture.clone();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double reach = 0;
  for (const Eigen::Vector3d& point : points.world)
    middle += point / static_cast<double>(points.world.size());
  for (const Eigen::Vector3d& point : points.world)
    reach = std::max(reach, (point - middle).norm());
  draw_ground_grid(image, fit.camera, middle.head<2>(), std::ceil(reach) + 2);
  draw_axes(image, fit.camera, Eigen::Vector3d::Zero(), std::min(1.0, std::max(reach, 0.05)));
  const int size = 4 * line_thickness(image);
  for (size_t i = 0; i < points.pixels.size(); ++i) {
    draw_ring(image, points.pixels[i], size, kFound);
    draw_thick_cross(image, points.pixels[i] - fit.misses[i], size, kMiss);
  }
  draw_caption(image,
               fmt::format("green given, red projected; rms {:.2f} px; 1 m grid", fit.rms_px));
  return image;
}

}  // namespace jobs
}  // namespace walktrack
