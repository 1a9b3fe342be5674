// The projection of a posed body: each part is a flat tapered capsule in the image.
//
// A capsule is the convex hull of two discs, in pixels of the given camera (pixel centres at
// integers). The radius at an end is the extent of the elliptic cross-section at right angles to
// the plane of the axis and the viewing ray,
//   r = sqrt((lateral l.n)^2 + (forward f.n)^2),   n = ray x axis / |ray x axis|,
// carried through the lens; the disc is on the axis, with its apex at that of the end's half
// ellipsoid. If the part is seen end-on, n has no direction and the disc gets the area of the
// cross-section; in between, the two are blended. Circular parts seen from the side are exact; the
// tests state the errors of the others: 0.1 px or less for half of the parts of a figure 190 px
// high, 2 px for the worst.
#pragma once

#include <array>
#include <span>

#include <Eigen/Core>

#include "body/kinematics.h"
#include "camera/camera.h"
#include "observation/silhouette/part_table.h"

namespace walktrack {
inline namespace observation {

struct Disc {
  Eigen::Vector2d centre;  // px
  double radius;           // px
};

struct Capsule {
  Disc lower, upper;
  double depth;  // of the middle of the axis, along the optical axis, m
  Appearance appearance;
  int part;  // index into the posed parts
};

inline constexpr size_t kMaxCapsules = kMaxParts;

// Nearest first. It is stored on the stack: a particle's likelihood allocates nothing.
class CapsuleList {
 public:
  size_t size() const { return size_; }
  const Capsule& operator[](size_t i) const { return items_[i]; }
  const Capsule* begin() const { return items_.data(); }
  const Capsule* end() const { return items_.data() + size_; }

  // Keeps the order by depth; throws std::length_error beyond kMaxCapsules.
  void insert(const Capsule& capsule);

 private:
  std::array<Capsule, kMaxCapsules> items_;
  size_t size_ = 0;
};

// The parts in front of the camera. A part that extends behind the camera is left out; one outside
// the image is not.
CapsuleList project_parts(const Camera& camera, std::span<const PosedPart> parts);

// The same outlines with all radii multiplied by `factor`.
CapsuleList scaled_radii(const CapsuleList& capsules, double factor);

// Whether a point is in the convex hull of the two discs (boundary included).
bool inside(const Capsule& capsule, const Eigen::Vector2d& point_px);

}  // namespace observation
}  // namespace walktrack
