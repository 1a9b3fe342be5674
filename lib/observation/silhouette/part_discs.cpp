#include "observation/silhouette/part_discs.h"

// Highway compiles this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "observation/silhouette/part_discs.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "observation/silhouette/flat_ends.h"

HWY_BEFORE_NAMESPACE();
namespace walktrack {
inline namespace observation {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

const hn::CappedTag<double, kPartVector> kReal;
using Real = hn::Vec<decltype(kReal)>;

// Square of the sine of the angle between ray and axis below which the end-on radius is blended in:
// within about 20 degrees of end-on, one half ellipsoid hides most of the part.
constexpr double kEndOn = 0.1;
// Below this value the direction across the axis is undefined.
constexpr double kAlongRay = 1e-12;

struct Vector {
  Real x, y, z;
};

HWY_ATTR Vector load(const VectorTable& table, size_t i) {
  return {hn::Load(kReal, table.x + i), hn::Load(kReal, table.y + i), hn::Load(kReal, table.z + i)};
}

HWY_ATTR Real dot(const Vector& a, const Vector& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_ATTR Vector cross(const Vector& a, const Vector& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

// a + s b
HWY_ATTR Vector moved(const Vector& a, Real s, const Vector& b) {
  return {hn::Add(a.x, hn::Mul(s, b.x)), hn::Add(a.y, hn::Mul(s, b.y)),
          hn::Add(a.z, hn::Mul(s, b.z))};
}

HWY_ATTR Vector divided(const Vector& a, Real s) {
  return {hn::Div(a.x, s), hn::Div(a.y, s), hn::Div(a.z, s)};
}

HWY_ATTR Vector turned(const Eigen::Matrix3d& r, const Vector& a) {
  const auto row = [&](int k) HWY_ATTR {
    return dot({hn::Set(kReal, r(k, 0)), hn::Set(kReal, r(k, 1)), hn::Set(kReal, r(k, 2))}, a);
  };
  return {row(0), row(1), row(2)};
}

// In camera axes, whose origin is the camera centre.
HWY_ATTR Vector seen(const Camera& camera, const Vector& point) {
  const Vector a = turned(camera.rotation, point);
  return {hn::Add(a.x, hn::Set(kReal, camera.translation.x())),
          hn::Add(a.y, hn::Set(kReal, camera.translation.y())),
          hn::Add(a.z, hn::Set(kReal, camera.translation.z()))};
}

struct Across {
  Vector normal;   // unit; at right angles to ray and axis
  Real side_view;  // share of the side-on radius, 0..1
};

HWY_ATTR Across across(const Vector& ray, const Vector& axis) {
  const Vector n = cross(ray, axis);
  const Real length2 = dot(n, n), sine2 = hn::Div(length2, dot(ray, ray));
  const auto lost = hn::Lt(sine2, hn::Set(kReal, kAlongRay));
  const Vector side{ray.z, hn::Zero(kReal), hn::Neg(ray.x)};  // any that is not along the ray
  const Vector unit = divided(n, hn::Sqrt(length2));
  const Vector aside = divided(side, hn::Sqrt(dot(side, side)));
  const Real share = hn::Min(hn::Set(kReal, 1.0), hn::Div(sine2, hn::Set(kReal, kEndOn)));
  return {{hn::IfThenElse(lost, aside.x, unit.x), hn::IfThenElse(lost, aside.y, unit.y),
           hn::IfThenElse(lost, aside.z, unit.z)},
          hn::IfThenZeroElse(lost, share)};
}

// One end of at most eight parts, in camera axes; `axis` is the unit vector from lower to upper,
// `outwards` the one away from the part.
struct End {
  Vector point, axis, outwards;
  Real lateral, forward;  // semi-axes of its cross-section
  Real least;             // largest outward shift of its disc: not beyond the middle of the part
};

HWY_ATTR void store_flat(const Vector& point, FlatPoints& out, size_t i) {
  hn::Store(hn::Div(point.x, point.z), kReal, out.x + i);
  hn::Store(hn::Div(point.y, point.z), kReal, out.y + i);
}

// Replaces a half ellipsoid of height h, whose outline is r wide at its base, by the disc of radius
// r with the same apex. Returns the smaller depth of the disc's middle and rim.
HWY_ATTR Real flatten(const End& end, const Vector& lateral, const Vector& forward, FlatEnds& out,
                      size_t i) {
  const Across view = across(end.point, end.axis);
  const Real l = hn::Mul(end.lateral, dot(lateral, view.normal));
  const Real f = hn::Mul(end.forward, dot(forward, view.normal));
  const Real side_on = hn::Sqrt(hn::Add(hn::Mul(l, l), hn::Mul(f, f)));
  const Real end_on = hn::Sqrt(hn::Mul(end.lateral, end.forward));
  const Real rest = hn::Sub(hn::Set(kReal, 1.0), view.side_view);
  const Real radius = hn::Add(hn::Mul(view.side_view, side_on), hn::Mul(rest, end_on));
  const Real height = hn::Mul(hn::Set(kReal, 0.5), hn::Add(end.lateral, end.forward));
  const Vector middle = moved(end.point, hn::Max(end.least, hn::Sub(height, radius)), end.outwards);
  const Vector rim = moved(middle, radius, view.normal);
  store_flat(middle, out.middle, i);
  store_flat(rim, out.rim, i);
  return hn::Min(middle.z, rim.z);
}

HWY_ATTR void flatten_parts(const Camera& camera, const PartTable& parts, FlatEnds& lower,
                            FlatEnds& upper, PartDiscs& out) {
  const Real half = hn::Set(kReal, 0.5);
  for (size_t i = 0; i < parts.count; i += hn::Lanes(kReal)) {
    const Vector bottom = seen(camera, load(parts.lower, i));
    const Vector top = seen(camera, load(parts.upper, i));
    const Vector lateral = turned(camera.rotation, load(parts.lateral, i));
    const Vector forward = turned(camera.rotation, load(parts.forward, i));
    const Vector along = moved(top, hn::Set(kReal, -1.0), bottom);
    const Real length = hn::Sqrt(dot(along, along));
    const Vector up = divided(along, length), down = divided(along, hn::Neg(length));
    const Real least = hn::Mul(hn::Set(kReal, -0.5), length);
    const Real near_bottom = flatten({bottom, up, down, hn::Load(kReal, parts.at_lower.lateral + i),
                                      hn::Load(kReal, parts.at_lower.forward + i), least},
                                     lateral, forward, lower, i);
    const Real near_top = flatten({top, up, up, hn::Load(kReal, parts.at_upper.lateral + i),
                                   hn::Load(kReal, parts.at_upper.forward + i), least},
                                  lateral, forward, upper, i);
    hn::Store(hn::Min(near_bottom, near_top), kReal, out.nearest + i);
    hn::Store(hn::Mul(half, hn::Add(bottom.z, top.z)), kReal, out.depth + i);
  }
}

// distort() of camera/camera.h for a lens of kBrown, inside the trusted radius.
HWY_ATTR void bend(const Camera& camera, const FlatPoints& flat, size_t count, FlatPoints& out) {
  const auto set = [](double value) HWY_ATTR { return hn::Set(kReal, value); };
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tx, ty] = camera.distortion;
  const Real a1 = set(k1), a2 = set(k2), a3 = set(k3), t1 = set(p1), t2 = set(p2);
  const Real one = set(1.0), two = set(2.0);
  for (size_t i = 0; i < count; i += hn::Lanes(kReal)) {
    const Real x = hn::Load(kReal, flat.x + i), y = hn::Load(kReal, flat.y + i);
    const Real xx = hn::Mul(x, x), yy = hn::Mul(y, y), xy2 = hn::Mul(two, hn::Mul(x, y));
    const Real r2 = hn::Add(xx, yy);
    const Real curve = hn::Add(a1, hn::Mul(r2, hn::Add(a2, hn::Mul(r2, a3))));
    const Real radial = hn::Add(one, hn::Mul(r2, curve));
    const Real x_aside = hn::Mul(t2, hn::Add(r2, hn::Mul(two, xx)));
    const Real y_aside = hn::Mul(t1, hn::Add(r2, hn::Mul(two, yy)));
    hn::Store(hn::Add(hn::Mul(x, radial), hn::Add(hn::Mul(t1, xy2), x_aside)), kReal, out.x + i);
    hn::Store(hn::Add(hn::Mul(y, radial), hn::Add(y_aside, hn::Mul(t2, xy2))), kReal, out.y + i);
  }
}

// From distorted coordinates to pixels.
HWY_ATTR void to_pixels(const Camera& camera, const FlatEnds& flat, size_t count, DiscTable& out) {
  const Real fx = hn::Set(kReal, camera.focal_px.x()), fy = hn::Set(kReal, camera.focal_px.y());
  const Real cx = hn::Set(kReal, camera.centre_px.x()), cy = hn::Set(kReal, camera.centre_px.y());
  for (size_t i = 0; i < count; i += hn::Lanes(kReal)) {
    const Real x = hn::Load(kReal, flat.middle.x + i), y = hn::Load(kReal, flat.middle.y + i);
    const Real dx = hn::Mul(fx, hn::Sub(hn::Load(kReal, flat.rim.x + i), x));
    const Real dy = hn::Mul(fy, hn::Sub(hn::Load(kReal, flat.rim.y + i), y));
    hn::Store(hn::Add(hn::Mul(fx, x), cx), kReal, out.x + i);
    hn::Store(hn::Add(hn::Mul(fy, y), cy), kReal, out.y + i);
    hn::Store(hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy))), kReal, out.radius + i);
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

HWY_EXPORT(flatten_parts);
HWY_EXPORT(bend);
HWY_EXPORT(to_pixels);

// Short formulas are evaluated for all lanes together; a long formula, or a point outside of the
// fitted range, is evaluated separately.
void bend_all(const Camera& camera, size_t count, FlatPoints& points) {
  const FlatPoints flat = points;
  const bool is_short = camera.lens == Lens::kBrown;
  if (is_short) HWY_DYNAMIC_DISPATCH(bend)(camera, flat, count, points);
  const double trusted2 = camera.trusted_radius * camera.trusted_radius;
  for (size_t i = 0; i < count; ++i) {
    if (is_short && flat.x[i] * flat.x[i] + flat.y[i] * flat.y[i] <= trusted2) continue;
    const Eigen::Vector2d bent = distort_any(camera, {flat.x[i], flat.y[i]});
    points.x[i] = bent.x();
    points.y[i] = bent.y();
  }
}

void project_ends(const Camera& camera, size_t count, FlatEnds& ends, DiscTable& out) {
  if (camera.lens != Lens::kPinhole) {
    bend_all(camera, count, ends.middle);
    bend_all(camera, count, ends.rim);
  }
  HWY_DYNAMIC_DISPATCH(to_pixels)(camera, ends, count, out);
}

}  // namespace

void find_discs(const Camera& camera, std::span<const PosedPart> parts, PartDiscs& out) {
  PartTable table;
  fill_table(parts, table);
  FlatEnds lower, upper;
  HWY_DYNAMIC_DISPATCH(flatten_parts)(camera, table, lower, upper, out);
  project_ends(camera, table.count, lower, out.lower);
  project_ends(camera, table.count, upper, out.upper);
}

}  // namespace observation
}  // namespace walktrack
#endif
