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

namespace {

// The parts in front of the camera, nearest first; parts of equal depth in their order.
struct ByDepth {
  std::array<uint8_t, kMaxParts> part;
  size_t count = 0;

  ByDepth(const PartDiscs& discs, size_t parts) {
    for (size_t i = 0; i < parts; ++i) {
      if (!(discs.nearest[i] >= kMinDepth)) continue;
      size_t at = count++;
      for (; at > 0 && discs.depth[part[at - 1]] > discs.depth[i]; --at) part[at] = part[at - 1];
      part[at] = static_cast<uint8_t>(i);
    }
  }
};

}  // namespace

CapsuleList project_parts(const Camera& camera, std::span<const PosedPart> parts) {
  PartDiscs discs;
  find_discs(camera, parts, discs);
  const auto disc = [](const PartDiscs::Ends& ends, size_t i) {
    return Disc{{ends.x[i], ends.y[i]}, ends.radius[i]};
  };
  const ByDepth order(discs, parts.size());
  CapsuleList out;
  for (size_t k = 0; k < order.count; ++k) {
    const size_t i = order.part[k];
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
