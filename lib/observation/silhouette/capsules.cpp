#include "observation/silhouette/capsules.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "observation/silhouette/part_discs.h"

namespace walktrack {
inline namespace observation {

using Eigen::Vector2d;

void CapsuleList::insert(const Capsule& capsule) {
  if (size_ == kMaxCapsules) throw std::length_error("more parts than kMaxCapsules");
  size_t at = size_++;
  for (; at > 0 && items_[at - 1].depth > capsule.depth; --at) items_[at] = items_[at - 1];
  items_[at] = capsule;
}

CapsuleList project_parts(const Camera& camera, std::span<const PosedPart> parts) {
  PartDiscs discs;
  find_discs(camera, parts, discs);
  const auto disc = [](const DiscTable& ends, size_t i) {
    return Disc{{ends.x[i], ends.y[i]}, ends.radius[i]};
  };
  CapsuleList out;
  for (size_t i = 0; i < parts.size(); ++i) {
    if (!(discs.nearest[i] >= kMinDepth)) continue;
    out.insert({disc(discs.lower, i), disc(discs.upper, i), discs.depth[i], parts[i].appearance,
                static_cast<int>(i)});
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

// The hull is the union of the discs centre(t) = a + t axis, radius(t) = r_a + t (r_b - r_a), 0 <=
// t <= 1. |p - centre(t)|^2 - radius(t)^2 is a parabola in t, open upwards unless one disc contains
// the other.
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

}  // namespace observation
}  // namespace walktrack
