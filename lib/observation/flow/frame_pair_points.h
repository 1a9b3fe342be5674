// Points on the capsules of a pose, and their pixels in two frames, for leg_order. In pixels
// throughout.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Core>

#include "observation/flow/frame_pair.h"
#include "observation/silhouette/capsules.h"

namespace walktrack {
inline namespace observation {

// A capsule with precomputed values for testing many points.
struct Shape {
  Eigen::Vector2d foot, axis, aside;  // lower centre; to the upper centre; unit vector across
  double radius, grow;                // at the foot; difference at the other end
  double inverse_curvature;  // see inside() of capsules.cpp; very large if one disc contains the
                             // other
};

// The shape of the capsule with its radii multiplied by `share`.
inline Shape shape_of(const Capsule& capsule, double share = 1) {
  constexpr double kOneDisc = 1e30;  // makes covers() use the larger end only
  const Eigen::Vector2d axis = capsule.upper.centre - capsule.lower.centre;
  const double radius = share * capsule.lower.radius;
  const double grow = share * capsule.upper.radius - radius;
  const double curvature = axis.squaredNorm() - grow * grow;
  return {capsule.lower.centre,
          axis,
          Eigen::Vector2d(-axis.y(), axis.x()) / (axis.norm() + 1e-9),
          radius,
          grow,
          curvature > 0 ? 1 / curvature : kOneDisc};
}

inline bool covers(const Shape& shape, const Eigen::Vector2d& point) {
  const Eigen::Vector2d p = point - shape.foot;
  const double t = std::clamp(
      (p.dot(shape.axis) + shape.radius * shape.grow) * shape.inverse_curvature, 0.0, 1.0);
  const double radius = shape.radius + t * shape.grow;
  return (p - t * shape.axis).squaredNorm() <= radius * radius;
}

// A point that moves with its capsule: a share `along` of the axis from the foot, and to the side
// by a share `aside` of the radius there.
struct MaterialPoint {
  double along, aside;
};

inline Eigen::Vector2d pixel_of(const Shape& shape, const MaterialPoint& point) {
  return shape.foot + point.along * shape.axis +
         point.aside * (shape.radius + point.along * shape.grow) * shape.aside;
}

inline MaterialPoint material_point(const Shape& shape, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d p = pixel - shape.foot;
  const double along = p.dot(shape.axis) / (shape.axis.squaredNorm() + 1e-9);
  return {along, p.dot(shape.aside) / (shape.radius + along * shape.grow + 1e-9)};
}

// The bounding box of a shape.
struct Box {
  Eigen::Vector2d low, high;
};

inline Box box_of(const Shape& shape) {
  const double radius = shape.radius + std::max(0.0, shape.grow);
  const Eigen::Vector2d end = shape.foot + shape.axis, reach(radius, radius);
  return {shape.foot.cwiseMin(end) - reach, shape.foot.cwiseMax(end) + reach};
}

inline bool meet(const Box& a, const Box& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

// A position between four pixels.
struct Between {
  const PairPixel* corner;  // the one with the lower x and y
  const PairPixel* below;   // the one under it
  float right, down;        // shares

  float mix(float PairPixel::*value) const {
    const float top = corner->*value + right * (corner[1].*value - corner->*value);
    const float bottom = below->*value + right * (below[1].*value - below->*value);
    return top + down * (bottom - top);
  }
  float precision() const { return (down < 0.5f ? corner : below)[right < 0.5f ? 0 : 1].precision; }
};

// nullopt outside the field.
inline std::optional<Between> between(const FramePair& pair, const Eigen::Vector2d& point) {
  const double x = point.x() - pair.area.x0, y = point.y() - pair.area.y0;
  if (!(x >= 0 && y >= 0 && x < pair.area.width() - 1 && y < pair.area.height() - 1)) return {};
  const auto i = static_cast<int>(x), j = static_cast<int>(y);
  const PairPixel* const corner = &pair.at(pair.area.x0 + i, pair.area.y0 + j);
  return Between{corner, corner + pair.area.width(), static_cast<float>(x - i),
                 static_cast<float>(y - j)};
}

}  // namespace observation
}  // namespace walktrack
