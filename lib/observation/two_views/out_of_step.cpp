#include "observation/two_views/out_of_step.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace walktrack {
inline namespace observation {

namespace {

using Eigen::Vector2d;

constexpr int kLargestLag = 15;  // frames
constexpr int kFewestInstants = 20;
// A camera is reported to lag if the planes miss each other by more than shadows and arms explain
// (m), and the lag reduces this distance by so much.
constexpr double kClearGap = 0.012, kClearGain = 0.6;
constexpr double kParallel = 0.03;  // smallest determinant of the planes' normals for which they
                                    // are taken to meet

// The vertical plane through a camera and the figure: normal . x = offset on the ground.
struct Plane {
  Vector2d normal;  // unit vector
  double offset;
};

using PlanePath = std::vector<std::optional<Plane>>;

PlanePath planes_of(const Camera& camera, const FigurePath& path) {
  PlanePath planes;
  for (const auto& figure : path) {
    planes.emplace_back();
    const auto ray = figure ? unproject(camera, figure->middle) : std::nullopt;
    if (!ray || ray->direction.head<2>().norm() < 1e-3) continue;
    const Vector2d along = ray->direction.head<2>().normalized();
    const Vector2d normal(-along.y(), along.x());
    planes.back() = Plane{normal, normal.dot(ray->origin.head<2>())};
  }
  return planes;
}

// Root mean square distance, m, of the planes at one time from the line nearest to them all.
std::optional<double> gap_at(const std::vector<PlanePath>& planes, int instant, size_t late,
                             int lag) {
  Eigen::Matrix2d normals = Eigen::Matrix2d::Zero();
  Vector2d right = Vector2d::Zero();
  std::vector<Plane> met;
  for (size_t i = 0; i < planes.size(); ++i) {
    const int at = instant + (i == late ? lag : 0);
    if (at < 0 || at >= static_cast<int>(planes[i].size())) return std::nullopt;
    const auto& plane = planes[i][static_cast<size_t>(at)];
    if (!plane) continue;
    normals += plane->normal * plane->normal.transpose();
    right += plane->offset * plane->normal;
    met.push_back(*plane);
  }
  if (met.size() < 3 || normals.determinant() < kParallel) return std::nullopt;
  const Vector2d meeting = normals.inverse() * right;
  double sum = 0;
  for (const Plane& plane : met) {
    const double distance = plane.normal.dot(meeting) - plane.offset;
    sum += distance * distance;
  }
  return std::sqrt(sum / static_cast<double>(met.size()));
}

// The median over all times; nullopt if there are too few.
std::optional<double> median_gap(const std::vector<PlanePath>& planes, size_t late, int lag) {
  std::vector<double> gaps;
  size_t instants = 0;
  for (const PlanePath& path : planes) instants = std::max(instants, path.size());
  for (int instant = 0; instant < static_cast<int>(instants); ++instant)
    if (const auto gap = gap_at(planes, instant, late, lag)) gaps.push_back(*gap);
  if (gaps.size() < kFewestInstants) return std::nullopt;
  const auto middle = gaps.begin() + std::ptrdiff_t(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  return *middle;
}

}  // namespace

std::vector<OutOfStep> find_out_of_step(const std::vector<Camera>& cameras,
                                        const std::vector<FigurePath>& paths) {
  std::vector<PlanePath> planes;
  for (size_t i = 0; i < cameras.size(); ++i) planes.push_back(planes_of(cameras[i], paths[i]));
  const auto before = median_gap(planes, 0, 0);
  if (!before || *before < kClearGap) return {};
  std::vector<OutOfStep> found;
  for (size_t camera = 0; camera < planes.size(); ++camera) {
    OutOfStep best{camera, 0, *before, *before};
    for (int lag = -kLargestLag; lag <= kLargestLag; ++lag) {
      const auto gap = median_gap(planes, camera, lag);
      if (gap && *gap < best.gap_after) best = {camera, lag, *before, *gap};
    }
    if (best.gap_after < kClearGain * *before) found.push_back(best);
  }
  std::sort(found.begin(), found.end(),
            [](const OutOfStep& a, const OutOfStep& b) { return a.gap_after < b.gap_after; });
  return found;
}

}  // namespace observation
}  // namespace walktrack
