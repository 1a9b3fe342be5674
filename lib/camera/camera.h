// A calibrated camera: where it stands, how its lens bends, how a world point becomes a pixel and
// a pixel a ray.
//
// x_camera = rotation * x_world + translation (camera_from_world; camera x right, y down, z ahead).
// Normalised coordinates (x, y) = (X/Z, Y/Z) are bent by the lens and scaled to pixels:
// u = fx x_d + cx, pixel centres at integers as in OpenCV. Lens models and the order of their
// coefficients are OpenCV's (calib3d documentation, "Detailed Description"; fisheye: Kannala &
// Brandt 2006):
//   kBrown    k1 k2 p1 p2 k3
//   kRational k1 k2 p1 p2 k3 k4 k5 k6 [s1 s2 s3 s4 [tau_x tau_y]]
//   kFisheye  k1 k2 k3 k4
//
// A distortion polynomial is fitted inside the image; far outside it may fold over and map a point
// behind a wall back into the picture. Beyond `trusted_radius` (normalised) the bending is
// therefore continued in proportion to the radius: continuous, and one to one.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include <Eigen/Core>

namespace walktrack {
inline namespace camera {

enum class Lens { kPinhole, kBrown, kRational, kFisheye };

struct Camera {
  int width_px = 0;
  int height_px = 0;
  Eigen::Vector2d focal_px{1, 1};
  Eigen::Vector2d centre_px{0, 0};
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // camera_from_world
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();   // m
  // Set together by set_distortion:
  Lens lens = Lens::kPinhole;
  std::array<double, 14> distortion{};
  double trusted_radius = std::numeric_limits<double>::infinity();
  Eigen::Matrix3d tilt = Eigen::Matrix3d::Identity();  // sensor tilt of the rational model
};

// Points nearer to the image plane than this (m), or behind it, have no pixel.
inline constexpr double kMinDepth = 0.01;

// 0, 4, 5, 8, 12 or 14 OpenCV coefficients, or 4 with fisheye; throws InputError for other counts
// or values that are not finite. Chooses the cheapest model that holds them.
void set_distortion(Camera& camera, std::span<const double> coefficients, bool fisheye = false);

// The coefficients in the shortest OpenCV form (0, 5, 8, 12 or 14; fisheye 4).
std::span<const double> distortion_coefficients(const Camera& camera);

// Bends normalised coordinates; d_distorted, if given, receives the Jacobian d distorted / d point.
Eigen::Vector2d distort_any(const Camera& camera, const Eigen::Vector2d& point,
                            Eigen::Matrix2d* d_distorted = nullptr);

// The inverse of distort; nullopt where no point maps there (outside a fisheye's half space).
std::optional<Eigen::Vector2d> undistort(const Camera& camera, const Eigen::Vector2d& distorted);

inline Eigen::Vector2d distort(const Camera& camera, const Eigen::Vector2d& point) {
  if (camera.lens == Lens::kPinhole) return point;
  const double r2 = point.squaredNorm();
  if (camera.lens != Lens::kBrown || r2 > camera.trusted_radius * camera.trusted_radius) {
    return distort_any(camera, point);
  }
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tx, ty] = camera.distortion;
  const double x = point.x(), y = point.y();
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

inline Eigen::Vector3d camera_point(const Camera& camera, const Eigen::Vector3d& point_world) {
  return camera.rotation * point_world + camera.translation;
}

// Pixel of a point in camera axes; nullopt nearer than kMinDepth or behind. The pixel may lie
// outside the image.
inline std::optional<Eigen::Vector2d> project_camera_point(const Camera& camera,
                                                           const Eigen::Vector3d& point_camera) {
  if (!(point_camera.z() >= kMinDepth)) return std::nullopt;
  const Eigen::Vector2d bent = distort(camera, point_camera.head<2>() / point_camera.z());
  return Eigen::Vector2d(camera.focal_px.cwiseProduct(bent) + camera.centre_px);
}

// As above, of a point in the world.
inline std::optional<Eigen::Vector2d> project(const Camera& camera,
                                              const Eigen::Vector3d& point_world) {
  return project_camera_point(camera, camera_point(camera, point_world));
}

// The pixel and how it moves with the point.
struct ProjectionWithJacobian {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> d_pixel_d_point;  // px/m, world axes
};
std::optional<ProjectionWithJacobian> project_with_jacobian(const Camera& camera,
                                                            const Eigen::Vector3d& point_world);

struct Ray {
  Eigen::Vector3d origin;     // world, m
  Eigen::Vector3d direction;  // world, unit length
};

// The ray through a pixel; nullopt where the lens has none.
std::optional<Ray> unproject(const Camera& camera, const Eigen::Vector2d& pixel);

// Where a pixel's ray meets the ground z = 0; nullopt at or above the horizon and for a
// camera that is not above the ground.
std::optional<Eigen::Vector3d> ground_point(const Camera& camera, const Eigen::Vector2d& pixel);

inline Eigen::Vector3d camera_centre(const Camera& camera) {
  return -camera.rotation.transpose() * camera.translation;
}

// Whether a pixel lies in the image, pixel squares included.
inline bool inside_image(const Camera& camera, const Eigen::Vector2d& pixel) {
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < camera.width_px - 0.5 &&
         pixel.y() < camera.height_px - 0.5;
}

// The same camera looking at an image shrunk by an integer factor (area averaging): pixel centres
// of the small image lie between those of the large one.
Camera scaled_down(const Camera& camera, int factor);

}  // namespace camera
}  // namespace walktrack
