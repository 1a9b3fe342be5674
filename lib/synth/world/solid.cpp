#include "synth/world/solid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>

#include "synth/world/polynomial.h"

namespace walktrack {
inline namespace synth {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kTube = 1 - 1e-6;

// A ray in the coordinates (x, y, s) of a solid; distances along it are in the world's metres.
struct LocalRay {
  Vector3d origin, step;
  Vector3d at(double t) const { return origin + t * step; }
};

struct Interval {
  double from, to;
};

// The interval of the ray in which the quadratic (x / a)^2 + (y / b)^2 + (s / c)^2 <= 1 holds; 1 /
// c = 0 stands for a cylinder.
std::optional<Interval> inside_quadric(const LocalRay& ray, const Vector3d& inverse_axes,
                                       double centre_s) {
  const Vector3d o = (ray.origin - Vector3d(0, 0, centre_s)).cwiseProduct(inverse_axes);
  const Vector3d d = ray.step.cwiseProduct(inverse_axes);
  const double a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - 1;
  const double discriminant = b * b - a * c;
  if (discriminant < 0 || a == 0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  return Interval{(-b - root) / a, (-b + root) / a};
}

// f(t) = x^2 b^2 + y^2 a^2 - a^2 b^2 as a polynomial of u in t = from + u (to - from).
Quartic side_polynomial(const ConeSolid& solid, const LocalRay& ray, Interval range) {
  using Line = std::pair<double, double>;  // p + q u
  const double span = range.to - range.from;
  const Vector3d o = ray.at(range.from), d = span * ray.step;
  const double da = solid.a1 - solid.a0, db = solid.b1 - solid.b0;
  const Line a{solid.a0 + da * o.z(), da * d.z()}, b{solid.b0 + db * o.z(), db * d.z()};
  const auto square = [](Line l) {
    return std::array{l.first * l.first, 2 * l.first * l.second, l.second * l.second};
  };
  const auto x2 = square({o.x(), d.x()}), y2 = square({o.y(), d.y()});
  const auto a2 = square(a), b2 = square(b);
  Quartic out{};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) out[i + k] += x2[i] * b2[k] + y2[i] * a2[k] - a2[i] * b2[k];
  }
  return out;
}

std::optional<double> side_entry(const ConeSolid& solid, const LocalRay& ray, Interval range) {
  if (ray.step.z() != 0) {  // clip to 0 <= s <= 1
    double from = -ray.origin.z() / ray.step.z(), to = (1 - ray.origin.z()) / ray.step.z();
    if (from > to) std::swap(from, to);
    range = {std::max(range.from, from), std::min(range.to, to)};
  } else if (ray.origin.z() < 0 || ray.origin.z() > 1) {
    return std::nullopt;
  }
  if (!(range.to > range.from)) return std::nullopt;
  const auto u = first_descent(side_polynomial(solid, ray, range));
  if (!u) return std::nullopt;
  return range.from + *u * (range.to - range.from);
}

// Entry into the half ellipsoid beyond an end, of whose surface only that half counts.
std::optional<double> cap_entry(const LocalRay& ray, double a, double b, double cap, double end) {
  const auto inside = inside_quadric(ray, Vector3d(1 / a, 1 / b, 1 / cap), end);
  if (!inside) return std::nullopt;
  const double s = ray.at(inside->from).z();
  if (end == 0 ? s > 0 : s < 1) return std::nullopt;
  return inside->from;
}

void keep_nearest(std::optional<double>& best, const std::optional<double>& found) {
  if (found && *found > 0 && (!best || *found < *best)) best = found;
}

}  // namespace

ConeSolid cone_solid(const PosedPart& part) {
  ConeSolid out;
  const Vector3d along = part.upper - part.lower;
  out.lower = part.lower;
  out.world_from_local.col(0) = part.forward;
  out.world_from_local.col(1) = part.lateral;
  out.world_from_local.col(2) = along;
  out.local_from_world = out.world_from_local.inverse();
  out.a0 = part.at_lower.forward;
  out.b0 = part.at_lower.lateral;
  out.a1 = part.at_upper.forward;
  out.b1 = part.at_upper.lateral;
  out.length = along.norm();
  out.cap0 = 0.5 * (out.a0 + out.b0) / out.length;
  out.cap1 = 0.5 * (out.a1 + out.b1) / out.length;
  out.middle = 0.5 * (part.lower + part.upper);
  // Oblique axes may add up, so that an end extends at most by the sum of its widest semi-axes.
  const double reach0 = std::max(out.a0, out.b0) + 0.5 * (out.a0 + out.b0);
  const double reach1 = std::max(out.a1, out.b1) + 0.5 * (out.a1 + out.b1);
  out.radius = 0.5 * out.length + std::max(reach0, reach1);
  return out;
}

Vector3d local_point(const ConeSolid& solid, const Vector3d& world) {
  return solid.local_from_world * (world - solid.lower);
}

Vector3d world_point(const ConeSolid& solid, const Vector3d& local) {
  return solid.lower + solid.world_from_local * local;
}

std::optional<double> entry_distance(const ConeSolid& solid, const Ray& ray, double farthest) {
  const Vector3d to_middle = solid.middle - ray.origin;
  const double nearest = to_middle.dot(ray.direction);
  if (nearest < -solid.radius || nearest - solid.radius > farthest ||
      to_middle.squaredNorm() - nearest * nearest > solid.radius * solid.radius)
    return std::nullopt;
  const LocalRay local{solid.local_from_world * (ray.origin - solid.lower),
                       solid.local_from_world * ray.direction};
  // The cylinder of the widest cross-sections contains the whole solid. It is slightly wider, so
  // that its surface never coincides with the solid's.
  const Vector3d widest(kTube / std::max(solid.a0, solid.a1), kTube / std::max(solid.b0, solid.b1),
                        0);
  const auto tube = inside_quadric(local, widest, 0);
  std::optional<double> best;
  if (tube) keep_nearest(best, side_entry(solid, local, *tube));
  // A ray along the axis has no interval in the tube but may intersect an end.
  if (tube || local.step.head<2>().isZero()) {
    keep_nearest(best, cap_entry(local, solid.a0, solid.b0, solid.cap0, 0));
    keep_nearest(best, cap_entry(local, solid.a1, solid.b1, solid.cap1, 1));
  }
  if (best && *best >= farthest) return std::nullopt;
  return best;
}

Vector3d surface_normal(const ConeSolid& solid, const Vector3d& local) {
  const double x = local.x(), y = local.y(), s = local.z();
  Vector3d gradient;
  if (s < 0 || s > 1) {
    const double a = s < 0 ? solid.a0 : solid.a1, b = s < 0 ? solid.b0 : solid.b1;
    const double cap = s < 0 ? solid.cap0 : solid.cap1, beyond = s < 0 ? s : s - 1;
    gradient = {x / (a * a), y / (b * b), beyond / (cap * cap)};
  } else {
    const double da = solid.a1 - solid.a0, db = solid.b1 - solid.b0;
    const double a = solid.a0 + da * s, b = solid.b0 + db * s;
    gradient = {x / (a * a), y / (b * b), -(x * x * da / (a * a * a) + y * y * db / (b * b * b))};
  }
  return (solid.local_from_world.transpose() * gradient).normalized();
}

std::optional<double> entry_distance(const BoxSolid& box, const Ray& ray, double farthest) {
  double from = 0, to = farthest;
  for (Eigen::Index i = 0; i < 3; ++i) {
    double near = (box.low[i] - ray.origin[i]) / ray.direction[i];
    double far = (box.high[i] - ray.origin[i]) / ray.direction[i];
    if (near > far) std::swap(near, far);
    // Comparisons in this order ignore the NaN of a ray that is in the plane of a face.
    if (near > from) from = near;
    if (far < to) to = far;
  }
  if (from <= 0 || from >= to) return std::nullopt;
  return from;
}

Vector3d surface_normal(const BoxSolid& box, const Vector3d& point) {
  const Vector3d half = 0.5 * (box.high - box.low);
  const Vector3d share = (point - 0.5 * (box.low + box.high)).cwiseQuotient(half);
  Eigen::Index axis = 0;
  share.cwiseAbs().maxCoeff(&axis);
  Vector3d normal = Vector3d::Zero();
  normal[axis] = share[axis] > 0 ? 1 : -1;
  return normal;
}

}  // namespace synth
}  // namespace walktrack
