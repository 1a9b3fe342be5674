#include "observation/silhouette/outline.h"

#include <algorithm>

// Highway compiles this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "observation/silhouette/outline.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace walktrack {
inline namespace observation {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

const hn::CappedTag<double, kPartVector> kReal;
const hn::Rebind<int32_t, decltype(kReal)> kWhole;
using Real = hn::Vec<decltype(kReal)>;
using Mask = hn::Mask<decltype(kReal)>;

// A horizontal edge adds nothing to the discs in any row.
constexpr double kLeastHeight_px = 1e-9;

struct PixelLanes {
  Real x, y;
};

struct DiscLanes {
  Real x, y, radius;
};

HWY_ATTR DiscLanes load(const DiscTable& table, size_t i) {
  return {hn::Load(kReal, table.x + i), hn::Load(kReal, table.y + i),
          hn::Load(kReal, table.radius + i)};
}

// The point of a disc's edge in the direction of a unit vector.
HWY_ATTR PixelLanes touched(const DiscLanes& disc, const PixelLanes& normal) {
  return {hn::Add(disc.x, hn::Mul(disc.radius, normal.x)),
          hn::Add(disc.y, hn::Mul(disc.radius, normal.y))};
}

HWY_ATTR void store_edge(const PixelLanes& a, const PixelLanes& b, Mask some, EdgeTable& out,
                         size_t i) {
  const auto a_first = hn::Lt(a.y, b.y);
  const Real top_x = hn::IfThenElse(a_first, a.x, b.x), top_y = hn::IfThenElse(a_first, a.y, b.y);
  const Real end_x = hn::IfThenElse(a_first, b.x, a.x), end_y = hn::IfThenElse(a_first, b.y, a.y);
  const Real height = hn::Sub(end_y, top_y);
  const auto there = hn::And(some, hn::Ge(height, hn::Set(kReal, kLeastHeight_px)));
  const Real slope = hn::Div(hn::Sub(end_x, top_x), height);
  hn::Store(hn::IfThenElse(there, top_y, hn::Set(kReal, 1.0)), kReal, out.first + i);
  hn::Store(hn::IfThenElseZero(there, end_y), kReal, out.last + i);
  hn::Store(hn::IfThenElseZero(there, hn::Sub(top_x, hn::Mul(slope, top_y))), kReal,
            out.x_at_0 + i);
  hn::Store(hn::IfThenElseZero(there, slope), kReal, out.slope + i);
}

// With e the unit axis, D its length and s = (r_a - r_b) / D, the outward normals of the edges are
// s e +- sqrt(1 - s^2) e_perp (the same at both discs). There are none if one disc contains the
// other.
HWY_ATTR void store_edges(const DiscLanes& a, const DiscLanes& b, EdgeTable (&out)[2], size_t i) {
  const Real dx = hn::Sub(b.x, a.x), dy = hn::Sub(b.y, a.y);
  const Real length = hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)));
  const Real shrinking = hn::Sub(a.radius, b.radius);
  const auto some = hn::Gt(length, hn::Abs(shrinking));
  const Real ex = hn::Div(dx, length), ey = hn::Div(dy, length), s = hn::Div(shrinking, length);
  const Real c = hn::Sqrt(hn::Sub(hn::Set(kReal, 1.0), hn::Mul(s, s)));
  for (const int side : {0, 1}) {
    const Real aside = side == 0 ? c : hn::Neg(c);
    const PixelLanes normal{hn::Add(hn::Mul(s, ex), hn::Mul(aside, hn::Neg(ey))),
                            hn::Add(hn::Mul(s, ey), hn::Mul(aside, ex))};
    store_edge(touched(a, normal), touched(b, normal), some, out[side], i);
  }
}

// Rows are clamped before they are converted to integers: a part close to the camera may be
// projected millions of pixels away.
HWY_ATTR void store_rows(const DiscLanes& a, const DiscLanes& b, const PixelRect& area,
                         Outlines& out, size_t i) {
  const auto set = [](int row) HWY_ATTR { return hn::Set(kReal, static_cast<double>(row)); };
  const auto clamped = [&](Real y, int low, int high)
                           HWY_ATTR { return hn::Max(set(low), hn::Min(set(high), y)); };
  const Real top = hn::Min(hn::Sub(a.y, a.radius), hn::Sub(b.y, b.radius));
  const Real bottom = hn::Max(hn::Add(a.y, a.radius), hn::Add(b.y, b.radius));
  const Real first = hn::Ceil(clamped(top, area.y0, area.y1));
  const Real last = hn::Floor(clamped(bottom, area.y0 - 1, area.y1 - 1));
  hn::StoreU(hn::DemoteTo(kWhole, first), kWhole, out.first_row + i);
  hn::StoreU(hn::DemoteTo(kWhole, hn::Add(last, set(1))), kWhole, out.end_row + i);
}

HWY_ATTR void find_outlines(size_t count, const PixelRect& area, Outlines& out) {
  for (size_t i = 0; i < count; i += hn::Lanes(kReal)) {
    const DiscLanes a = load(out.discs[0], i), b = load(out.discs[1], i);
    store_rows(a, b, area, out, i);
    store_edges(a, b, out.edges, i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace observation
}  // namespace walktrack
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace walktrack {
inline namespace observation {

namespace {

HWY_EXPORT(find_outlines);

void set(DiscTable& table, size_t i, const Disc& disc) {
  table.x[i] = disc.centre.x();
  table.y[i] = disc.centre.y();
  table.radius[i] = disc.radius;
}

}  // namespace

// Vectors are complete: the lanes after the last capsule repeat it.
void find_outlines(const CapsuleList& capsules, const PixelRect& area, Outlines& out) {
  const size_t count = (capsules.size() + kPartVector - 1) / kPartVector * kPartVector;
  for (size_t i = 0; i < count; ++i) {
    const Capsule& capsule = capsules[std::min(i, capsules.size() - 1)];
    set(out.discs[0], i, capsule.lower);
    set(out.discs[1], i, capsule.upper);
  }
  HWY_DYNAMIC_DISPATCH(find_outlines)(count, area, out);
}

}  // namespace observation
}  // namespace walktrack
#endif
