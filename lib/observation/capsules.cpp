#include "observation/capsules.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <Eigen/Geometry>

namespace walktrack {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Square of the sine of the angle between ray and axis below which the end-on radius blends in:
// within about 20 degrees of end-on, one half ellipsoid hides most of the part.
constexpr double kEndOn = 0.1;

struct EndOnBlend {
  Vector3d normal;   // world, unit; at right angles to ray and axis
  double side_view;  // share of the side-on radius, 0..1
};

// The view along `ray` of a part with the unit vector `axis`.
EndOnBlend across(const Vector3d& ray, const Vector3d& axis) {
  const Vector3d cross = ray.cross(axis);
  const double sine2 = cross.squaredNorm() / (ray.squaredNorm());
  if (sine2 < 1e-12) return {ray.unitOrthogonal(), 0};
  return {cross.normalized(), std::min(1.0, sine2 / kEndOn)};
}

double extent(const PosedPart& part, const CrossSection& section, const EndOnBlend& view) {
  const double l = section.lateral * part.lateral.dot(view.normal);
  const double f = section.forward * part.forward.dot(view.normal);
  const double side_on = std::sqrt(l * l + f * f);
  if (view.side_view >= 1) return side_on;
  const double end_on = std::sqrt(section.lateral * section.forward);
  return view.side_view * side_on + (1 - view.side_view) * end_on;
}

// The disc at one end; `outwards` is the unit axis away from the part. A half ellipsoid of height h
// with an outline r wide at its foot is replaced by the disc of radius r that has the same apex.
std::optional<Disc> project_end(const Camera& camera, const PosedPart& part, const EndOnBlend& view,
                                const Vector3d& end, const Vector3d& outwards,
                                const CrossSection& section) {
  const double radius = extent(part, section, view);
  const double height = 0.5 * (section.lateral + section.forward);
  const double least = -0.5 * (part.upper - part.lower).norm();
  const Vector3d centre = end + std::max(least, height - radius) * outwards;
  const auto middle = project(camera, centre), rim = project(camera, centre + radius * view.normal);
  if (!middle || !rim) return std::nullopt;
  return Disc{*middle, (*rim - *middle).norm()};
}

}  // namespace

void CapsuleList::insert(const Capsule& capsule) {
  if (size_ == kMaxCapsules) throw std::length_error("more parts than kMaxCapsules");
  size_t at = size_++;
  for (; at > 0 && items_[at - 1].depth > capsule.depth; --at) items_[at] = items_[at - 1];
  items_[at] = capsule;
}

CapsuleList project_parts(const Camera& camera, std::span<const PosedPart> parts) {
  CapsuleList out;
  const Vector3d eye = camera_centre(camera);
  for (size_t i = 0; i < parts.size(); ++i) {
    const PosedPart& part = parts[i];
    const Vector3d axis = (part.upper - part.lower).normalized();
    const auto lower =
        project_end(camera, part, across(part.lower - eye, axis), part.lower, -axis, part.at_lower);
    const auto upper =
        project_end(camera, part, across(part.upper - eye, axis), part.upper, axis, part.at_upper);
    if (!lower || !upper) continue;
    const double depth =
        camera.rotation.row(2).dot(0.5 * (part.lower + part.upper)) + camera.translation.z();
    out.insert({*lower, *upper, depth, part.appearance, static_cast<int>(i)});
  }
  return out;
}

CapsuleList scaled_radii(const CapsuleList& capsules, double factor) {
  CapsuleList out;
  for (Capsule capsule : capsules) {
    capsule.lower.radius *= factor;
    capsule.upper.radius *= factor;
    out.insert(capsule);
  }
  return out;
}

// The hull is the union of the discs centre(t) = a + t axis, radius(t) = r_a + t (r_b - r_a),
// 0 <= t <= 1. |p - centre(t)|^2 - radius(t)^2 is a parabola in t, open upwards unless one disc
// holds the other.
bool inside(const Capsule& capsule, const Vector2d& point_px) {
  const Disc &a = capsule.lower, &b = capsule.upper;
  const Vector2d axis = b.centre - a.centre, p = point_px - a.centre;
  const double grow = b.radius - a.radius;
  const auto within = [&](double t) {
    return (p - t * axis).squaredNorm() <= std::pow(a.radius + t * grow, 2);
  };
  const double curvature = axis.squaredNorm() - grow * grow;
  if (curvature <= 0) return within(0) || within(1);
  return within(std::clamp((p.dot(axis) + a.radius * grow) / curvature, 0.0, 1.0));
}

}  // namespace walktrack
