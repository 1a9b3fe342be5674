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
// A figure as high as so many steps of the grid is so wide that it is seen from every second place.
constexpr double kLargeInSteps = 12;
// A place between others is tried if one of them is worse than an empty scene by less than this
// share of what the best one explains: of somebody half hidden few places explain anything.
constexpr double kHope = 0.5;

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

// 0, step, ... below the end.
std::vector<double> steps_to(double end, double step) {
  std::vector<double> out;
  for (double at = 0; at < end; at += step) out.push_back(at);
  return out;
}

struct Cell {
  size_t row, column;
};

// The places in every second row and column around a cell; none if the cell is one of these or one
// of them has no place.
std::vector<uint32_t> guides_of(const Cell& cell, size_t rows, size_t columns,
                                std::span<const int64_t> number) {
  std::vector<uint32_t> out;
  if (cell.row % 2 == 0 && cell.column % 2 == 0) return out;
  for (const size_t row : {cell.row - cell.row % 2, cell.row + cell.row % 2}) {
    for (const size_t column : {cell.column - cell.column % 2, cell.column + cell.column % 2}) {
      const bool inside = row < rows && column < columns;
      const int64_t place = inside ? number[row * columns + column] : -1;
      if (place < 0) return {};
      out.push_back(static_cast<uint32_t>(place));
    }
  }
  return out;
}

}  // namespace

double height_px(const Camera& camera, const Vector2d& position, double height) {
  const Outline figure = outline(camera, position, height);
  return figure.foot && figure.head ? (*figure.foot - *figure.head).norm() : 0;
}

double side_on_heading(const Camera& camera, const Vector2d& position) {
  const Vector3d camera_position = camera_centre(camera);
  return std::atan2(position.y() - camera_position.y(), position.x() - camera_position.x()) +
         0.5 * kPi;
}

PlaceGrid place_grid(std::span<const Camera> cameras, double height, const DetectorConfig& config) {
  const Camera& camera = cameras[0];
  const double step = std::max(2.0, config.grid_px * camera.width_px / 640.0);
  const std::vector<double> u = steps_to(camera.width_px, step),
                            v = steps_to(camera.height_px, 0.5 * step);
  const size_t rows = v.size(), columns = u.size();
  PlaceGrid out;
  std::vector<Cell> cells;
  std::vector<int64_t> number(rows * columns, -1);  // of the place of a cell
  for (size_t row = 0; row < rows; ++row) {
    for (size_t column = 0; column < columns; ++column) {
      const Vector2d pixel(u[column], v[row]);
      const auto ground = ground_point(camera, pixel);
      if (!ground || !visible_everywhere(cameras, ground->head<2>(), height)) continue;
      number[row * columns + column] = std::ssize(out.places);
      cells.push_back({row, column});
      out.places.push_back(ground->head<2>());
    }
  }
  out.guides.resize(out.places.size());
  for (size_t i = 0; i < cells.size(); ++i) {
    if (height_px(camera, out.places[i], height) >= kLargeInSteps * step)
      out.guides[i] = guides_of(cells[i], rows, columns, number);
  }
  return out;
}

std::vector<Vector2d> standing_places(std::span<const Camera> cameras, double height,
                                      const DetectorConfig& config) {
  return place_grid(cameras, height, config).places;
}

std::vector<Place> find_figures(const PlaceScore& score, const PlaceGrid& grid,
                                const DetectorConfig& config, int threads) {
  const std::vector<Vector2d>& places = grid.places;
  std::vector<double> scores(places.size(), 0);
  parallel_for(places.size(), threads, [&](size_t i) {
    if (grid.guides[i].empty()) scores[i] = score(places[i]);
  });
  const double best = scores.empty() ? 0 : *std::max_element(scores.begin(), scores.end());
  const auto has_hope = [&](uint32_t guide) { return scores[guide] > -kHope * best; };
  std::vector<size_t> between;
  for (size_t i = 0; i < places.size(); ++i) {
    if (std::any_of(grid.guides[i].begin(), grid.guides[i].end(), has_hope)) between.push_back(i);
  }
  parallel_for(between.size(), threads,
               [&](size_t k) { scores[between[k]] = score(places[between[k]]); });
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
