#include "synth/recording/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel_for.h"

namespace walktrack {
inline namespace synth {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kSubRays = 3;   // on each side: nine rays for a pixel on an edge
constexpr double kRimPx = 2;  // lens distortion and rounding move a silhouette by less
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Pixels [x0, x1) x [y0, y1).
struct Rect {
  int x0, y0, x1, y1;
};

// The ray at an offset (in pixels, within half of one) from a pixel's centre, interpolated from its
// neighbours' rays: over one pixel lens distortion is linear to 1e-6 of it.
Ray ray_at(const View& view, int x, int y, double dx, double dy) {
  const auto direction = [&](int px, int py) -> Vector3d {
    return view.directions
        .at(std::clamp(px, 0, view.camera.width_px - 1),
            std::clamp(py, 0, view.camera.height_px - 1))
        .cast<double>();
  };
  const Vector3d centre = direction(x, y);
  if (dx == 0 && dy == 0) return {view.centre, centre};
  const int sx = x > 0 ? -1 : 1, sy = y > 0 ? -1 : 1;
  const Vector3d turn =
      dx * sx * (direction(x + sx, y) - centre) + dy * sy * (direction(x, y + sy) - centre);
  return {view.centre, (centre + turn).normalized()};
}

// Offsets of the sub-pixel rays.
std::array<Vector2d, kSubRays * kSubRays> sub_rays() {
  std::array<Vector2d, kSubRays * kSubRays> out;
  for (int i = 0; i < kSubRays * kSubRays; ++i) {
    const int column = i % kSubRays, row = i / kSubRays;
    out[static_cast<size_t>(i)] =
        Vector2d(column + 0.5, row + 0.5) / kSubRays - Vector2d::Constant(0.5);
  }
  return out;
}

// Extends the rectangle by the image of a ball; to the whole image if the camera is inside the
// ball.
void extend(const View& view, const Vector3d& middle, double radius, Rect& rect, bool& whole) {
  const Vector3d at = camera_point(view.camera, middle);
  if (at.z() < 1.2 * radius + kMinDepth) {
    whole = whole || at.norm() < 1.5 * radius || at.z() > -radius;
    return;
  }
  const auto pixel = project_camera_point(view.camera, at);
  if (!pixel) return;
  // 1.4: in the corner of a wide-angle image a ball is an oval.
  const Vector2d reach =
      1.4 * view.camera.focal_px * radius / (at.z() - radius) + Vector2d::Constant(kRimPx);
  const auto bounded = [](double value) { return static_cast<int>(std::clamp(value, -1e6, 1e6)); };
  rect.x0 = std::min(rect.x0, bounded(pixel->x() - reach.x()));
  rect.y0 = std::min(rect.y0, bounded(pixel->y() - reach.y()));
  rect.x1 = std::max(rect.x1, bounded(pixel->x() + reach.x()) + 2);
  rect.y1 = std::max(rect.y1, bounded(pixel->y() + reach.y()) + 2);
}

Rect finished(const View& view, Rect rect, bool whole) {
  const int w = view.camera.width_px, h = view.camera.height_px;
  if (whole) return {0, 0, w, h};
  return {std::max(rect.x0, 0), std::max(rect.y0, 0), std::min(rect.x1, w), std::min(rect.y1, h)};
}

constexpr Rect kNothing{1 << 20, 1 << 20, -(1 << 20), -(1 << 20)};

// Radii of balls at the two ends of a part whose convex hull contains it.
double end_radius(double a, double b) { return std::max(a, b) + 0.5 * (a + b); }

Rect image_of(const View& view, const ConeSolid& solid) {
  Rect rect = kNothing;
  bool whole = false;
  extend(view, solid.lower, end_radius(solid.a0, solid.b0), rect, whole);
  extend(view, world_point(solid, {0, 0, 1}), end_radius(solid.a1, solid.b1), rect, whole);
  return finished(view, rect, whole);
}

// A rectangle that contains the part's shadow on the ground.
Rect shadow_of(const View& view, const ConeSolid& solid, const Vector3d& sun) {
  Rect rect = kNothing;
  bool whole = false;
  for (const auto& [end, radius] :
       {std::pair{solid.lower, end_radius(solid.a0, solid.b0)},
        std::pair{world_point(solid, {0, 0, 1}), end_radius(solid.a1, solid.b1)}}) {
    const Vector3d fallen = end - end.z() / sun.z() * sun;
    extend(view, fallen, radius / sun.z(), rect, whole);
  }
  return finished(view, rect, whole);
}

struct Hit {
  Sight sight;
  double distance = kInfinity;
};

// The nearest of several parts on a ray, if it is nearer than `farthest`.
Hit nearest_part(std::span<const DressedParts> walkers, const Ray& ray, double farthest) {
  Hit hit;
  hit.distance = farthest;
  for (size_t w = 0; w < walkers.size(); ++w) {
    for (size_t p = 0; p < walkers[w].solids.size(); ++p) {
      const auto found = entry_distance(walkers[w].solids[p], ray, hit.distance);
      if (!found) continue;
      hit.distance = *found;
      hit.sight = {static_cast<int16_t>(w), static_cast<int16_t>(p), static_cast<float>(*found)};
    }
  }
  return hit;
}

bool in_shadow(std::span<const DressedParts> walkers, const Vector3d& point, const Vector3d& sun) {
  const Ray ray{point + kShadowGap * sun, sun};
  for (const DressedParts& walker : walkers) {
    for (const ConeSolid& solid : walker.solids) {
      if (entry_distance(solid, ray, kInfinity)) return true;
    }
  }
  return false;
}

Colour look_of_part(const World& world, std::span<const DressedParts> walkers, const Ray& ray,
                    const Hit& hit) {
  const DressedParts& walker = walkers[static_cast<size_t>(hit.sight.walker)];
  const size_t p = static_cast<size_t>(hit.sight.part);
  const ConeSolid& solid = walker.solids[p];
  const Vector3d point = ray.origin + hit.distance * ray.direction;
  const Vector3d local = local_point(solid, point);
  const Vector3d normal = surface_normal(solid, local), sun = towards_sun(world.light);
  const double incidence = std::max(0.0, normal.dot(sun));
  double lit = world.light.sun * incidence;
  if (world.light.shadows && lit > 0 && in_shadow(walkers, point + kShadowGap * normal, sun))
    lit = 0;
  // Ambient light from above is weaker on surfaces that face down: half of it comes from the
  // ground.
  const double ambient = world.light.ambient * (0.75 + 0.25 * normal.z());
  const Vector3d on_part(local.x(), local.y(), local.z() * solid.length);
  const Material& material = (*walker.clothes)[static_cast<size_t>(walker.appearance[p])];
  return colour_at(material, on_part + Vector3d::Constant(0.37 * static_cast<double>(p)),
                   world.noise) *
         static_cast<float>(ambient + lit);
}

// Finds the part that the ray through a pixel's centre hits, nearest first.
void find_sights(const View& view, std::span<const DressedParts> walkers, Plane<Sight>& sights) {
  for (size_t w = 0; w < walkers.size(); ++w) {
    for (size_t p = 0; p < walkers[w].solids.size(); ++p) {
      const ConeSolid& solid = walkers[w].solids[p];
      const Rect rect = image_of(view, solid);
      for (int y = rect.y0; y < rect.y1; ++y) {
        for (int x = rect.x0; x < rect.x1; ++x) {
          Sight& sight = sights.at(x, y);
          const auto found =
              entry_distance(solid, ray_at(view, x, y, 0, 0), static_cast<double>(sight.distance));
          if (found)
            sight = {static_cast<int16_t>(w), static_cast<int16_t>(p), static_cast<float>(*found)};
        }
      }
    }
  }
}

// Calls f(x, y, point on the ground) for the pixels of a rectangle whose rays meet the ground.
template <typename F>
void for_ground(const View& view, const Rect& rect, const F& f) {
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) {
      const size_t i = view.static_thing.index(x, y);
      if (view.static_thing.values[i] != kGround) continue;
      const Ray ray = ray_at(view, x, y, 0, 0);
      f(x, y,
        Vector3d(ray.origin + static_cast<double>(view.static_distance.values[i]) * ray.direction));
    }
  }
}

// Darkens the ground where a part blocks the sun.
void cast_shadows(const View& view, const World& world, std::span<const DressedParts> walkers,
                  Plane<Colour>& colour) {
  const Vector3d sun = towards_sun(world.light);
  if (!world.light.shadows || sun.z() <= 0) return;
  Plane<uint8_t> shaded(view.camera.width_px, view.camera.height_px, 0);
  for (const DressedParts& walker : walkers) {
    for (const ConeSolid& solid : walker.solids) {
      for_ground(view, shadow_of(view, solid, sun), [&](int x, int y, const Vector3d& point) {
        uint8_t& done = shaded.at(x, y);
        if (done != 0 || !entry_distance(solid, {point, sun}, kInfinity)) return;
        done = 1;
        colour.at(x, y) *= 1 - view.sun_share.at(x, y);
      });
    }
  }
}

// Balls in a row that represent a part, each as large as the part is wide.
struct Ball {
  Vector3d middle;
  double radius;
};

std::vector<Ball> balls_of(const ConeSolid& solid) {
  const double low = 0.5 * (solid.a0 + solid.b0), high = 0.5 * (solid.a1 + solid.b1);
  const int count = std::max(1, static_cast<int>(std::lround(solid.length / (low + high))));
  std::vector<Ball> out;
  for (int i = 0; i < count; ++i) {
    const double along = (i + 0.5) / count;
    out.push_back({world_point(solid, {0, 0, along}), low + along * (high - low)});
  }
  return out;
}

// Share of the ambient light that a ball above a point of the ground blocks: its form factor (r /
// d)^2 cos (Howell, A catalog of radiation heat transfer configuration factors, B-37).
double kept_off(const Ball& ball, const Vector3d& point) {
  const Vector3d way = ball.middle - point;
  const double distance2 = std::max(way.squaredNorm(), ball.radius * ball.radius);
  return std::clamp(ball.radius * ball.radius * way.z() / (distance2 * std::sqrt(distance2)), 0.0,
                    1.0);
}

// Darkens the ground where walkers block ambient light. Balls farther than kContactReach block less
// than a grey level.
void contact_shadows(const View& view, const World& world, std::span<const DressedParts> walkers,
                     Plane<Colour>& colour) {
  constexpr double kContactReach = 0.7;  // m
  if (!world.light.contact_shadows) return;
  Plane<float> open(view.camera.width_px, view.camera.height_px, 1);
  for (const DressedParts& walker : walkers) {
    for (const ConeSolid& solid : walker.solids) {
      for (const Ball& ball : balls_of(solid)) {
        if (ball.middle.z() > kContactReach) continue;
        Rect rect = kNothing;
        bool whole = false;
        extend(view, {ball.middle.x(), ball.middle.y(), 0}, kContactReach, rect, whole);
        for_ground(view, finished(view, rect, whole), [&](int x, int y, const Vector3d& point) {
          open.at(x, y) *= static_cast<float>(1 - kept_off(ball, point));
        });
      }
    }
  }
  for (size_t i = 0; i < open.values.size(); ++i)
    colour.values[i] -= (1 - open.values[i]) * view.ambient_share.values[i] * view.empty.values[i];
}

// The change that walkers make to a pixel of the ground that mirrors them, averaged over its
// sub-rays.
Colour mirrored_change(const View& view, const World& world, std::span<const DressedParts> walkers,
                       int x, int y) {
  static const auto kOffsets = sub_rays();
  const double distance = static_cast<double>(view.static_distance.at(x, y));
  Colour sum = Colour::Zero();
  for (const Vector2d& offset : kOffsets) {
    const Ray ray = ray_at(view, x, y, offset.x(), offset.y());
    const Ray up = mirrored(ray, distance);
    const StaticHit behind = first_static_hit(world, up);
    const Hit hit = nearest_part(walkers, up, behind.distance);
    if (hit.sight.walker < 0) continue;
    sum += static_cast<float>(mirrored_share(world, ray)) *
           (look_of_part(world, walkers, up, hit) - look_of(world, up, behind).colour);
  }
  return sum / static_cast<float>(kOffsets.size());
}

// Replaces what the ground mirrors by walkers where these are nearer.
void mirror_walkers(const View& view, const World& world, std::span<const DressedParts> walkers,
                    Plane<Colour>& colour) {
  if (world.gloss == 0) return;
  Plane<uint8_t> done(view.camera.width_px, view.camera.height_px, 0);
  for (const DressedParts& walker : walkers) {
    for (const ConeSolid& solid : walker.solids) {
      const auto below = [](const Vector3d& point) {
        return Vector3d(point.x(), point.y(), -point.z());
      };
      Rect rect = kNothing;
      bool whole = false;
      extend(view, below(solid.lower), end_radius(solid.a0, solid.b0), rect, whole);
      extend(view, below(world_point(solid, {0, 0, 1})), end_radius(solid.a1, solid.b1), rect,
             whole);
      for_ground(view, finished(view, rect, whole), [&](int x, int y, const Vector3d&) {
        if (done.at(x, y) != 0) return;
        done.at(x, y) = 1;
        colour.at(x, y) += mirrored_change(view, world, walkers, x, y);
      });
    }
  }
}

bool on_edge(const Plane<Sight>& sights, int x, int y) {
  const Sight& own = sights.at(x, y);
  const auto differs = [&](int px, int py) {
    if (px < 0 || py < 0 || px >= sights.width || py >= sights.height) return false;
    const Sight& neighbour = sights.at(px, py);
    return neighbour.walker != own.walker || neighbour.part != own.part;
  };
  return differs(x - 1, y) || differs(x + 1, y) || differs(x, y - 1) || differs(x, y + 1);
}

Colour pixel_colour(const View& view, const World& world, std::span<const DressedParts> walkers,
                    const Colour& background, int x, int y, bool edge) {
  static const auto kOffsets = sub_rays();
  const double farthest = static_cast<double>(view.static_distance.at(x, y));
  const auto seen = [&](const Vector2d& offset) -> Colour {
    const Ray ray = ray_at(view, x, y, offset.x(), offset.y());
    const Hit hit = nearest_part(walkers, ray, farthest);
    return hit.sight.walker < 0 ? background : look_of_part(world, walkers, ray, hit);
  };
  if (!edge) return seen(Vector2d::Zero());
  Colour sum = Colour::Zero();
  for (const Vector2d& offset : kOffsets) sum += seen(offset);
  return sum / static_cast<float>(kOffsets.size());
}

void fill_row(const World& world, int y, View& view) {
  static const auto kOffsets = sub_rays();
  for (int x = 0; x < view.camera.width_px; ++x) {
    const size_t i = view.empty.index(x, y);
    const Ray middle = ray_at(view, x, y, 0, 0);
    if (middle.direction.isZero()) continue;
    const StaticHit hit = first_static_hit(world, middle);
    view.static_thing.values[i] = hit.thing;
    view.static_distance.values[i] = static_cast<float>(hit.distance);
    Colour sum = Colour::Zero();
    float sun = 0, ambient = 0;
    for (const Vector2d& offset : kOffsets) {
      const Ray ray = ray_at(view, x, y, offset.x(), offset.y());
      const StaticLook look = look_of(world, ray, first_static_hit(world, ray));
      sum += look.colour;
      sun += look.shaded_share * look.sun_share;
      ambient += look.shaded_share * (1 - look.sun_share);
    }
    view.empty.values[i] = sum / static_cast<float>(kOffsets.size());
    view.sun_share.values[i] = sun / static_cast<float>(kOffsets.size());
    view.ambient_share.values[i] = ambient / static_cast<float>(kOffsets.size());
  }
}

}  // namespace

View make_view(const World& world, const Camera& camera, int threads) {
  const int w = camera.width_px, h = camera.height_px;
  View view{camera,
            camera_centre(camera),
            {w, h, Eigen::Vector3f::Zero()},
            {w, h, Colour::Zero()},
            {w, h, 0.0f},
            {w, h, 0.0f},
            {w, h, std::numeric_limits<float>::infinity()},
            {w, h, kSky}};
  const size_t rows = static_cast<size_t>(h);
  parallel_for(rows, threads, [&](size_t y) {
    for (int x = 0; x < w; ++x) {
      const auto ray = unproject(camera, {x, static_cast<double>(y)});
      if (ray) view.directions.at(x, static_cast<int>(y)) = ray->direction.cast<float>();
    }
  });
  parallel_for(rows, threads, [&](size_t y) { fill_row(world, static_cast<int>(y), view); });
  return view;
}

DressedParts dress(std::span<const PosedPart> parts, const Clothes& clothes) {
  DressedParts out;
  out.clothes = &clothes;
  for (const PosedPart& part : parts) {
    out.solids.push_back(cone_solid(part));
    out.appearance.push_back(part.appearance);
  }
  return out;
}

Picture render(const View& view, const World& world, std::span<const DressedParts> walkers) {
  Picture out{view.empty, {view.camera.width_px, view.camera.height_px, Sight{}}};
  for (size_t i = 0; i < out.sights.values.size(); ++i)
    out.sights.values[i].distance = view.static_distance.values[i];
  find_sights(view, walkers, out.sights);
  cast_shadows(view, world, walkers, out.colour);
  contact_shadows(view, world, walkers, out.colour);
  mirror_walkers(view, world, walkers, out.colour);
  for (int y = 0; y < out.colour.height; ++y) {
    for (int x = 0; x < out.colour.width; ++x) {
      const bool edge = on_edge(out.sights, x, y);
      if (!edge && out.sights.at(x, y).walker < 0) continue;
      Colour& colour = out.colour.at(x, y);
      colour = pixel_colour(view, world, walkers, colour, x, y, edge);
    }
  }
  return out;
}

Plane<float> depth_of(const View& view, const Plane<Sight>& sights) {
  Plane<float> out(sights.width, sights.height, 0);
  const Eigen::Vector3f ahead = view.camera.rotation.row(2).transpose().cast<float>();
  for (size_t i = 0; i < out.values.size(); ++i)
    out.values[i] = sights.values[i].distance * ahead.dot(view.directions.values[i]);
  return out;
}

Plane<Eigen::Vector2f> flow_of(const View& view, const Plane<Sight>& sights,
                               std::span<const DressedParts> now,
                               std::span<const DressedParts> next) {
  Plane<Eigen::Vector2f> out(sights.width, sights.height, Eigen::Vector2f::Zero());
  for (int y = 0; y < sights.height; ++y) {
    for (int x = 0; x < sights.width; ++x) {
      const Sight& sight = sights.at(x, y);
      if (sight.walker < 0) continue;
      const size_t w = static_cast<size_t>(sight.walker), p = static_cast<size_t>(sight.part);
      const Ray ray = ray_at(view, x, y, 0, 0);
      const Vector3d point = ray.origin + static_cast<double>(sight.distance) * ray.direction;
      const Vector3d local = local_point(now[w].solids[p], point);
      Vector2d flow = Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
      if (w < next.size() && p < next[w].solids.size()) {
        if (const auto pixel = project(view.camera, world_point(next[w].solids[p], local)))
          flow = *pixel - Vector2d(x, y);
      }
      out.at(x, y) = flow.cast<float>();
    }
  }
  return out;
}

Plane<uint8_t> labels_of(const Plane<Sight>& sights) {
  Plane<uint8_t> out(sights.width, sights.height, 0);
  for (size_t i = 0; i < out.values.size(); ++i) {
    const Sight& sight = sights.values[i];
    if (sight.walker >= 0)
      out.values[i] = static_cast<uint8_t>(std::min(1 + sight.part + 100 * sight.walker, 255));
  }
  return out;
}

}  // namespace synth
}  // namespace walktrack
