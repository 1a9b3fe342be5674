#include "camera/camera.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/conventions.h"
#include "core/errors.h"

namespace walktrack {
inline namespace camera {

namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// A lens model that is one to one up to this normalised radius (85 degrees off the axis) is used
// everywhere.
constexpr double kLargestRadius = 11.4;
// Limits of the slope of the distorted radius, near which the model folds over or has a pole.
constexpr double kSmallestSlope = 0.05;
constexpr double kLargestSlope = 10;
constexpr double kRadiusStep = 0.002;

// cv::detail::computeTiltProjectionMatrix: the sensor rotated by tau_x, tau_y about its axes.
Matrix3d tilt_matrix(double tau_x, double tau_y) {
  const double cx = std::cos(tau_x), sx = std::sin(tau_x);
  const double cy = std::cos(tau_y), sy = std::sin(tau_y);
  Matrix3d about_x, about_y, along_z;
  // clang-format off
  about_x << 1,   0,  0,
             0,  cx, sx,
             0, -sx, cx;
  about_y << cy, 0, -sy,
              0, 1,   0,
             sy, 0,  cy;
  const Matrix3d turn = about_y * about_x;
  along_z << turn(2, 2),          0, -turn(0, 2),
                      0, turn(2, 2), -turn(1, 2),
                      0,          0,           1;
  // clang-format on
  return along_z * turn;
}

struct Bent {
  Vector2d point;
  Matrix2d jacobian;
};

// kBrown and kRational: radial part L = (1 + k1 r2 + k2 r4 + k3 r6) / (1 + k4 r2 + k5 r4 + k6 r6),
// tangential part p, thin prism s, then the tilt.
Bent bend_polynomial(const Camera& camera, const Vector2d& point) {
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tx, ty] = camera.distortion;
  const double x = point.x(), y = point.y(), r2 = point.squaredNorm(), r4 = r2 * r2;
  const double above = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double below = 1 + r2 * (k4 + r2 * (k5 + r2 * k6));
  const double d_above = k1 + r2 * (2 * k2 + 3 * k3 * r2);
  const double d_below = k4 + r2 * (2 * k5 + 3 * k6 * r2);
  const double radial = above / below;
  const double d_radial = (d_above - radial * d_below) / below;  // dL / d r2
  Bent bent;
  bent.point << x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x) + s1 * r2 + s2 * r4,
      y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y + s3 * r2 + s4 * r4;
  const Vector2d prism(s1 + 2 * s2 * r2, s3 + 2 * s4 * r2);
  bent.jacobian << radial + 2 * p1 * y + 6 * p2 * x, 2 * p1 * x + 2 * p2 * y,
      2 * p1 * x + 2 * p2 * y, radial + 6 * p1 * y + 2 * p2 * x;
  bent.jacobian += (d_radial * point + prism) * (2 * point).transpose();
  if (tx != 0 || ty != 0) {
    const Vector3d tilted = camera.tilt * bent.point.homogeneous();
    bent.point = tilted.hnormalized();
    const Eigen::Matrix<double, 2, 3> d_hnormalized =
        (Eigen::Matrix<double, 2, 3>() << Matrix2d::Identity(), -bent.point).finished() /
        tilted.z();
    bent.jacobian = (d_hnormalized * camera.tilt.leftCols<2>() * bent.jacobian).eval();
  }
  return bent;
}

// kFisheye: theta_d = theta (1 + k1 theta^2 + ... + k4 theta^8), theta = atan r.
Bent bend_fisheye(const Camera& camera, const Vector2d& point) {
  const auto& k = camera.distortion;
  const double r = point.norm();
  if (r < 1e-9) return {point, Matrix2d::Identity()};
  const double theta = std::atan(r), t2 = theta * theta;
  const double factor = 1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3])));
  const double slope = 1 + t2 * (3 * k[0] + t2 * (5 * k[1] + t2 * (7 * k[2] + t2 * 9 * k[3])));
  const Vector2d unit = point / r;
  const Matrix2d along = unit * unit.transpose();
  const double scale = theta * factor / r;
  return {scale * point, scale * (Matrix2d::Identity() - along) + slope / (1 + r * r) * along};
}

Bent bend(const Camera& camera, const Vector2d& point) {
  if (camera.lens == Lens::kPinhole) return {point, Matrix2d::Identity()};
  return camera.lens == Lens::kFisheye ? bend_fisheye(camera, point)
                                       : bend_polynomial(camera, point);
}

// bend() inside the trusted radius R; outside, f(x) = |x|/R bend(R x/|x|).
Bent bend_everywhere(const Camera& camera, const Vector2d& point) {
  const double radius = point.norm();
  if (radius <= camera.trusted_radius) return bend(camera, point);
  const Vector2d unit = point / radius;
  const Bent rim = bend(camera, camera.trusted_radius * unit);
  const Matrix2d across = Matrix2d::Identity() - unit * unit.transpose();
  return {radius / camera.trusted_radius * rim.point,
          rim.point * unit.transpose() / camera.trusted_radius + rim.jacobian * across};
}

// Whether the lens model is one to one at this radius: along sixteen spokes (one for a fisheye,
// which is symmetric), the distorted point moves outwards with the point, and its slope is neither
// near 0 nor near infinity.
bool spreads(const Camera& camera, double radius) {
  // The slope of an arc tangent is small by nature; for a fisheye the growth of the angle is
  // tested.
  const bool fisheye = camera.lens == Lens::kFisheye;
  const double stretch = fisheye ? 1 + radius * radius : 1;
  const int spokes = fisheye ? 1 : 16;
  for (int spoke = 0; spoke < spokes; ++spoke) {
    const double angle = spoke * kPi / 8;
    const Vector2d unit(std::cos(angle), std::sin(angle));
    const Matrix2d jacobian = bend(camera, radius * unit).jacobian;
    const double slope = stretch * unit.dot(jacobian * unit);
    if (!(slope > kSmallestSlope && slope < kLargestSlope)) return false;
    if (!(jacobian.determinant() > 0)) return false;
  }
  return true;
}

double find_trusted_radius(const Camera& camera) {
  double radius = 0;
  while (spreads(camera, radius + kRadiusStep)) {
    radius += kRadiusStep;
    if (radius > kLargestRadius) return std::numeric_limits<double>::infinity();
  }
  return radius;
}

Lens lens_for(const std::array<double, 14>& coefficients, bool fisheye) {
  if (fisheye) return Lens::kFisheye;
  size_t used = coefficients.size();
  while (used > 0 && coefficients[used - 1] == 0) --used;
  if (used == 0) return Lens::kPinhole;
  return used <= 5 ? Lens::kBrown : Lens::kRational;
}

}  // namespace

void set_distortion(Camera& camera, std::span<const double> coefficients, bool fisheye) {
  const size_t n = coefficients.size();
  const bool known = n == 0 || n == 4 || (!fisheye && (n == 5 || n == 8 || n == 12 || n == 14));
  if (!known) {
    throw InputError(describe({"", 0, "distortion_coefficients"}, std::to_string(n) + " values",
                              fisheye ? "4 for a fisheye lens" : "0, 4, 5, 8, 12 or 14"));
  }
  for (const double value : coefficients) {
    if (!std::isfinite(value)) {
      throw InputError(describe({"", 0, "distortion_coefficients"}, "a value that is not finite",
                                "finite numbers"));
    }
  }
  camera.distortion.fill(0);
  std::copy(coefficients.begin(), coefficients.end(), camera.distortion.begin());
  camera.lens = lens_for(camera.distortion, fisheye);
  camera.tilt = camera.lens == Lens::kRational
                    ? tilt_matrix(camera.distortion[12], camera.distortion[13])
                    : Matrix3d::Identity();
  camera.trusted_radius = camera.lens == Lens::kPinhole ? std::numeric_limits<double>::infinity()
                                                        : find_trusted_radius(camera);
}

std::span<const double> distortion_coefficients(const Camera& camera) {
  if (camera.lens == Lens::kPinhole) return {};
  if (camera.lens == Lens::kFisheye) return {camera.distortion.data(), 4};
  size_t used = camera.distortion.size();
  while (used > 0 && camera.distortion[used - 1] == 0) --used;
  for (const size_t count : {5u, 8u, 12u}) {
    if (used <= count) return {camera.distortion.data(), count};
  }
  return camera.distortion;
}

Vector2d distort_any(const Camera& camera, const Vector2d& point, Matrix2d* d_distorted) {
  const Bent bent = bend_everywhere(camera, point);
  if (d_distorted) *d_distorted = bent.jacobian;
  return bent.point;
}

std::optional<Vector2d> undistort(const Camera& camera, const Vector2d& distorted) {
  if (camera.lens == Lens::kPinhole) return distorted;
  // Damped Newton; the map is one to one, so that few steps suffice. 1e-12 normalised is 1e-9 px.
  constexpr int kMaxSteps = 50;
  constexpr double kTolerance = 1e-12;
  Vector2d point = distorted;
  if (camera.lens == Lens::kFisheye) {
    const double angle = distorted.norm();
    if (angle > 1e-9) point *= std::tan(std::min(angle, 1.4)) / angle;
  }
  Bent bent = bend_everywhere(camera, point);
  double miss = (bent.point - distorted).norm();
  for (int step = 0; step < kMaxSteps && miss > kTolerance; ++step) {
    const Vector2d full = bent.jacobian.inverse() * (distorted - bent.point);
    bool better = false;
    for (double share = 1; share > 1e-4 && !better; share /= 2) {
      const Vector2d trial = point + share * full;
      const Bent trial_bent = bend_everywhere(camera, trial);
      const double trial_miss = (trial_bent.point - distorted).norm();
      if (trial_miss < miss) {
        point = trial;
        bent = trial_bent;
        miss = trial_miss;
        better = true;
      }
    }
    if (!better) break;
  }
  // Rounding may stop the steps slightly above the tolerance; a real failure is far larger.
  if (!(miss < 1e-9 * (1 + distorted.norm()))) return std::nullopt;
  return point;
}

std::optional<ProjectionWithJacobian> project_with_jacobian(const Camera& camera,
                                                            const Vector3d& point_world) {
  const Vector3d point = camera_point(camera, point_world);
  if (!(point.z() >= kMinDepth)) return std::nullopt;
  const Vector2d flat = point.head<2>() / point.z();
  const Bent bent = bend_everywhere(camera, flat);
  Eigen::Matrix<double, 2, 3> d_flat;
  d_flat << Matrix2d::Identity(), -flat;
  d_flat /= point.z();
  return ProjectionWithJacobian{
      camera.focal_px.cwiseProduct(bent.point) + camera.centre_px,
      camera.focal_px.asDiagonal() * bent.jacobian * d_flat * camera.rotation};
}

std::optional<Ray> unproject(const Camera& camera, const Vector2d& pixel) {
  const auto flat = undistort(camera, (pixel - camera.centre_px).cwiseQuotient(camera.focal_px));
  if (!flat) return std::nullopt;
  return Ray{camera_centre(camera),
             (camera.rotation.transpose() * flat->homogeneous()).normalized()};
}

std::optional<Vector3d> ground_point(const Camera& camera, const Vector2d& pixel) {
  const auto ray = unproject(camera, pixel);
  if (!ray || ray->direction.z() >= 0) return std::nullopt;
  const double distance = -ray->origin.z() / ray->direction.z();
  if (!(distance > 0)) return std::nullopt;
  return Vector3d(ray->origin + distance * ray->direction);
}

Camera scaled_down(const Camera& camera, int factor) {
  Camera small = camera;
  small.width_px = camera.width_px / factor;
  small.height_px = camera.height_px / factor;
  small.focal_px = camera.focal_px / factor;
  small.centre_px = (camera.centre_px.array() + 0.5) / factor - 0.5;
  return small;
}

}  // namespace camera
}  // namespace walktrack
