#include "observation/silhouette/outline.h"

#include <algorithm>
#include <cmath>

namespace walktrack {
inline namespace observation {

namespace {

using Eigen::Vector2d;

Edge edge_between(const Vector2d& a, const Vector2d& b) {
  const Vector2d& top = a.y() < b.y() ? a : b;
  const Vector2d& bottom = a.y() < b.y() ? b : a;
  const double height = bottom.y() - top.y();
  // A horizontal edge adds nothing to the discs in any row.
  if (height < 1e-9) return {};
  const double slope = (bottom.x() - top.x()) / height;
  return {top.y(), bottom.y(), top.x() - slope * top.y(), slope};
}

// With e the unit axis, D its length and s = (r_a - r_b) / D, the outward normals of the edges are
// s e +- sqrt(1 - s^2) e_perp (the same at both discs).
void add_edges(const Disc& a, const Disc& b, Outline& out) {
  const Vector2d axis = b.centre - a.centre;
  const double length = axis.norm();
  if (length <= std::abs(a.radius - b.radius)) return;
  const Vector2d e = axis / length, perpendicular(-e.y(), e.x());
  const double s = (a.radius - b.radius) / length, c = std::sqrt(1 - s * s);
  for (const int side : {0, 1}) {
    const Vector2d normal = s * e + (side == 0 ? c : -c) * perpendicular;
    out.edges[side] = edge_between(a.centre + a.radius * normal, b.centre + b.radius * normal);
  }
}

// Rows are clamped before they are converted to integers: a part close to the camera may be
// projected millions of pixels away.
int clamped_row(double value, int low, int high) {
  return static_cast<int>(std::clamp(value, static_cast<double>(low), static_cast<double>(high)));
}

}  // namespace

Outline outline_of(const Capsule& capsule, const PixelRect& area) {
  const Disc &a = capsule.lower, &b = capsule.upper;
  Outline out{{a, b}, {}, 0, 0};
  const double top = std::min(a.centre.y() - a.radius, b.centre.y() - b.radius);
  const double bottom = std::max(a.centre.y() + a.radius, b.centre.y() + b.radius);
  out.first_row = clamped_row(std::ceil(top), area.y0, area.y1);
  out.end_row = clamped_row(std::floor(bottom) + 1, area.y0, area.y1);
  if (out.first_row < out.end_row) add_edges(a, b, out);
  return out;
}

}  // namespace observation
}  // namespace walktrack
