// A calibrated camera: its pose, its lens distortion, the projection of world points to pixels, and
// the rays of pixels.
//
// x_camera = rotation * x_world + translation (camera_from_world; camera x right, y down, z ahead).
// The lens distorts normalised coordinates (x, y) = (X/Z, Y/Z), which are then scaled to pixels:
// u = fx x_d + cx, with pixel centres at integers as in OpenCV. Lens models and the order of their
// coefficients are OpenCV's (calib3d documentation, "Detailed Description"; fisheye: Kannala &
// Brandt 2006):
//   kBrown    k1 k2 p1 p2 k3
//   kRational k1 k2 p1 p2 k3 k4 k5 k6 [s1 s2 s3 s4 [tau_x tau_y]]
//   kFisheye  k1 k2 k3 k4
//
// A distortion polynomial is fitted inside the image; far outside, it may fold over and map a point
// that is not visible into the image. Beyond `trusted_radius` (normalised) the distortion is
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
// or values that are not finite. Chooses the simplest model that contains them.
void set_distortion(Camera& camera, std::span<const double> coefficients, bool fisheye = false);

// The coefficients in the shortest OpenCV form (0, 5, 8, 12 or 14; fisheye 4).
std::span<const double> distortion_coefficients(const Camera& camera);

// Distorts normalised coordinates; d_distorted, if given, receives the Jacobian d distorted / d
// point.
Eigen::Vector2d distort_any(const Camera& camera, const Eigen::Vector2d& point,
                            Eigen::Matrix2d* d_distorted = nullptr);

// The inverse of distort; nullopt if no point is mapped there (outside a fisheye's half space).
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

// The pixel of a point in camera axes, which may be outside the image; nullopt if it is nearer than
// kMinDepth or behind the camera.
inline std::optional<Eigen::Vector2d> project_camera_point(const Camera& camera,
                                                           const Eigen::Vector3d& point_camera) {
  if (!(point_camera.z() >= kMinDepth)) return std::nullopt;
  const Eigen::Vector2d bent = distort(camera, point_camera.head<2>() / point_camera.z());
  return Eigen::Vector2d(camera.focal_px.cwiseProduct(bent) + camera.centre_px);
}

// The same for a point in the world.
inline std::optional<Eigen::Vector2d> project(const Camera& camera,
                                              const Eigen::Vector3d& point_world) {
  return project_camera_point(camera, camera_point(camera, point_world));
}

// The pixel with its derivatives.
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

// The ray through a pixel; nullopt if the lens has none.
std::optional<Ray> unproject(const Camera& camera, const Eigen::Vector2d& pixel);

// The intersection of a pixel's ray with the ground z = 0; nullopt at or above the horizon, and for
// a camera that is not above the ground.
std::optional<Eigen::Vector3d> ground_point(const Camera& camera, const Eigen::Vector2d& pixel);

inline Eigen::Vector3d camera_centre(const Camera& camera) {
  return -camera.rotation.transpose() * camera.translation;
}

// Whether a pixel is in the image, with the area of the pixels included.
inline bool inside_image(const Camera& camera, const Eigen::Vector2d& pixel) {
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < camera.width_px - 0.5 &&
         pixel.y() < camera.height_px - 0.5;
}

// The same camera for an image that is shrunk by an integer factor (area averaging): pixel centres
// of the small image are between those of the large one.
Camera scaled_down(const Camera& camera, int factor);

}  // namespace camera
}  // namespace walktrack
