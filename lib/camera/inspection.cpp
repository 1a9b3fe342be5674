#include "camera/inspection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/conventions.h"

namespace walktrack {
inline namespace camera {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kPlacesAlongASide = 32;  // of the grid of pixels on which a place to stand is
                                       // searched
constexpr int kBorderPoints = 16;      // on each side

Vector2d last_pixel(const Camera& camera) {
  return {camera.width_px - 1.0, camera.height_px - 1.0};
}

// The point on the ground below a pixel, if it is not further than kFarthestGround.
std::optional<Vector2d> near_ground(const Camera& camera, const Vector2d& pixel) {
  const auto point = ground_point(camera, pixel);
  if (!point || (*point - camera_centre(camera)).norm() > kFarthestGround) return std::nullopt;
  return Vector2d(point->head<2>());
}

double angle_between(const Camera& camera, const Vector2d& a, const Vector2d& b) {
  const auto first = unproject(camera, a), second = unproject(camera, b);
  if (!first || !second) return kPi;
  return std::acos(std::clamp(first->direction.dot(second->direction), -1.0, 1.0));
}

std::vector<Vector2d> ground_border(const Camera& camera) {
  const Vector2d end = last_pixel(camera);
  const std::array<Vector2d, 5> corners{Vector2d(0, end.y()), end, Vector2d(end.x(), 0),
                                        Vector2d(0, 0), Vector2d(0, end.y())};
  std::vector<Vector2d> border;
  for (size_t side = 0; side < 4; ++side) {
    for (int i = 0; i < kBorderPoints; ++i) {
      const double share = static_cast<double>(i) / kBorderPoints;
      const auto point =
          near_ground(camera, corners[side] + share * (corners[side + 1] - corners[side]));
      if (point) border.push_back(*point);
    }
  }
  return border;
}

// A person who is seen whole.
struct SeenWhole {
  Vector2d place;       // on the ground, m
  Vector2d feet, head;  // px

  double height_px() const { return (feet - head).norm(); }
};

// At the places of a grid of pixels.
std::vector<SeenWhole> people_seen_whole(const Camera& camera, double person_height) {
  std::vector<SeenWhole> out;
  for (int row = 0; row <= kPlacesAlongASide; ++row) {
    for (int column = 0; column <= kPlacesAlongASide; ++column) {
      const Vector2d pixel = last_pixel(camera).cwiseProduct(Vector2d(column, row)) /
                             static_cast<double>(kPlacesAlongASide);
      const auto place = near_ground(camera, pixel);
      if (!place || !sees_person(camera, *place, person_height)) continue;
      out.push_back({*place, pixel, *project(camera, {place->x(), place->y(), person_height})});
    }
  }
  return out;
}

void find_standing_place(const Camera& camera, double person_height, CameraInspection& found) {
  const Vector2d end = last_pixel(camera);
  double nearest = std::numeric_limits<double>::infinity();
  for (const SeenWhole& person : people_seen_whole(camera, person_height)) {
    const double distance = (0.5 * (person.feet + person.head) - 0.5 * end).norm() +
                            std::abs(person.height_px() - 0.5 * camera.height_px);
    if (distance >= nearest) continue;
    nearest = distance;
    found.standing_place = person.place;
    found.person_px = person.height_px();
  }
}

}  // namespace

Vector3d hips_at(const Vector2d& place, double person_height) {
  return {place.x(), place.y(), 0.5 * person_height};
}

bool in_any_picture(std::span<const Camera> cameras, const Vector3d& point) {
  return std::ranges::any_of(cameras, [&](const Camera& camera) {
    const auto pixel = project(camera, point);
    return pixel && inside_image(camera, *pixel);
  });
}

bool share_a_view(const Camera& camera, const Camera& other, double person_height) {
  constexpr double kAsHigh = 0.5;  // as at the standing place: far away all views meet; by hand
  CameraInspection own;
  find_standing_place(camera, person_height, own);
  const std::vector<SeenWhole> people = people_seen_whole(camera, person_height);
  return std::any_of(people.begin(), people.end(), [&](const SeenWhole& person) {
    return person.height_px() >= kAsHigh * own.person_px &&
           in_any_picture({&other, 1}, hips_at(person.place, person_height));
  });
}

bool sees_person(const Camera& camera, const Vector2d& place, double person_height) {
  for (const double height : {0.0, person_height}) {
    const auto pixel = project(camera, {place.x(), place.y(), height});
    if (!pixel || !inside_image(camera, *pixel)) return false;
  }
  return true;
}

bool lens_covers_image(const Camera& camera) {
  for (const double u : {-0.5, camera.width_px - 0.5}) {
    for (const double v : {-0.5, camera.height_px - 0.5}) {
      const auto ray =
          undistort(camera, (Vector2d(u, v) - camera.centre_px).cwiseQuotient(camera.focal_px));
      if (!ray || ray->norm() > camera.trusted_radius) return false;
    }
  }
  return true;
}

double metres_per_px(const Camera& camera, const Eigen::Vector2d& place) {
  const auto low = project(camera, {place.x(), place.y(), 0.5}),
             high = project(camera, {place.x(), place.y(), 1.5});
  return low && high ? 1 / (*high - *low).norm() : 0;
}

CameraInspection inspect_camera(const Camera& camera, double person_height) {
  const Vector3d right = camera.rotation.row(0), up = -camera.rotation.row(1),
                 ahead = camera.rotation.row(2);
  const Vector2d end = last_pixel(camera), middle = 0.5 * end;
  CameraInspection found;
  found.centre = camera_centre(camera);
  found.tilt = std::asin(std::clamp(-ahead.z(), -1.0, 1.0));
  found.roll = std::atan2(-right.z(), up.z());
  found.horizontal_view = angle_between(camera, {0, middle.y()}, {end.x(), middle.y()});
  found.vertical_view = angle_between(camera, {middle.x(), 0}, {middle.x(), end.y()});
  found.footprint = ground_border(camera);
  find_standing_place(camera, person_height, found);
  return found;
}

}  // namespace camera
}  // namespace walktrack
