#include "tracker/detect/figure_places.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/conventions.h"
#include "core/parallel_for.h"

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// By hand; sensitivity not measured.
constexpr double kLeastHeight_px = 24;  // a smaller figure shows no gait
constexpr double kApart = 0.5;          // m, between figures that count as two

struct Outline {
  std::optional<Vector2d> foot, head;
};

Outline outline(const Camera& camera, const Vector2d& position, double height) {
  return {project(camera, Vector3d(position.x(), position.y(), 0)),
          project(camera, Vector3d(position.x(), position.y(), height))};
}

bool wholly_inside(const Camera& camera, const Outline& figure) {
  const double half_width = 0.15 * (*figure.foot - *figure.head).norm();
  for (const auto& pixel : {*figure.foot, *figure.head}) {
    if (pixel.x() < half_width || pixel.x() > camera.width_px - half_width || pixel.y() < 0 ||
        pixel.y() > camera.height_px)
      return false;
  }
  return true;
}

bool visible_everywhere(std::span<const Camera> cameras, const Vector2d& position, double height) {
  for (const Camera& camera : cameras) {
    const Outline figure = outline(camera, position, height);
    if (!figure.foot || !figure.head) continue;
    if (!wholly_inside(camera, figure)) return false;
    if ((*figure.foot - *figure.head).norm() < kLeastHeight_px) return false;
  }
  return true;
}

}  // namespace

double side_on_heading(const Camera& camera, const Vector2d& position) {
  const Vector3d camera_position = camera_centre(camera);
  return std::atan2(position.y() - camera_position.y(), position.x() - camera_position.x()) +
         0.5 * kPi;
}

std::vector<Vector2d> standing_places(std::span<const Camera> cameras, double height,
                                      const DetectorConfig& config) {
  const Camera& camera = cameras[0];
  const double step = std::max(2.0, config.grid_px * camera.width_px / 640.0);
  std::vector<Vector2d> places;
  for (double v = 0; v < camera.height_px; v += 0.5 * step) {
    for (double u = 0; u < camera.width_px; u += step) {
      const auto ground = ground_point(camera, Vector2d(u, v));
      if (ground && visible_everywhere(cameras, ground->head<2>(), height))
        places.push_back(ground->head<2>());
    }
  }
  return places;
}

std::vector<Place> find_figures(const PlaceScore& score, std::span<const Vector2d> places,
                                const DetectorConfig& config, int threads) {
  std::vector<double> scores(places.size());
  parallel_for(places.size(), threads, [&](size_t i) { scores[i] = score(places[i]); });
  std::vector<size_t> order(places.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return scores[a] > scores[b]; });
  std::vector<Place> found;
  for (const size_t i : order) {
    if (static_cast<int>(found.size()) >= config.candidates || scores[i] <= 0) break;
    const bool apart = std::all_of(found.begin(), found.end(), [&](const Place& place) {
      return (place.position - places[i]).norm() > kApart;
    });
    if (apart) found.push_back({places[i], scores[i]});
  }
  return found;
}

}  // namespace tracker
}  // namespace walktrack
