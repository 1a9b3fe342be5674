// What a camera sees of a posed body: each part as a flat tapered capsule in the image.
//
// A capsule is the convex hull of two discs, in pixels of the camera given (pixel centres at
// integers). The radius at an end is the extent of the elliptic cross-section at right angles to
// the plane of axis and viewing ray,
//   r = sqrt((lateral l.n)^2 + (forward f.n)^2),   n = ray x axis / |ray x axis|,
// carried through the lens; the disc stands on the axis where its apex is that of the end's half
// ellipsoid. Seen end-on, n has no direction and the disc takes the area of the cross-section; in
// between, the two blend. Round parts seen from the side are exact; the tests say how far the
// others are off: half the parts of a figure 190 px high by 0.1 px, the worst by 2 px.
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
  double depth;  // of the middle of the axis along the optical axis, m
  Appearance appearance;
  int part;  // index into the posed parts
};

inline constexpr size_t kMaxCapsules = kMaxParts;

// Nearest first. Lives on the stack: a particle's likelihood allocates nothing.
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

// The parts in front of the camera. A part that reaches behind it is left out; one that lies
// outside the image is not.
CapsuleList project_parts(const Camera& camera, std::span<const PosedPart> parts);

// The same outlines with all radii multiplied by `factor`.
CapsuleList scaled_radii(const CapsuleList& capsules, double factor);

// Whether a point lies in the convex hull of the two discs (boundary included).
bool inside(const Capsule& capsule, const Eigen::Vector2d& point_px);

}  // namespace observation
}  // namespace walktrack
