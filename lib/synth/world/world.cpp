#include "synth/world/world.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace walktrack {
inline namespace synth {

namespace {

using Eigen::Vector3d;

std::optional<double> entry(const Thing& thing, const Ray& ray, double farthest) {
  return std::visit([&](const auto& solid) { return entry_distance(solid, ray, farthest); },
                    thing.solid);
}

Vector3d normal_at(const Thing& thing, const Vector3d& point) {
  if (const auto* box = std::get_if<BoxSolid>(&thing.solid)) return surface_normal(*box, point);
  const ConeSolid& cone = std::get<ConeSolid>(thing.solid);
  return surface_normal(cone, local_point(cone, point));
}

bool in_static_shadow(const World& world, const Vector3d& point, const Vector3d& sun) {
  const Ray ray{point + kShadowGap * sun, sun};
  return std::any_of(world.things.begin(), world.things.end(), [&](const Thing& thing) {
    return thing.casts_shadow && entry(thing, ray, std::numeric_limits<double>::infinity());
  });
}

}  // namespace

Vector3d towards_sun(const Light& light) {
  const double across = std::cos(light.elevation);
  return {across * std::cos(light.azimuth), across * std::sin(light.azimuth),
          std::sin(light.elevation)};
}

ConeSolid upright_cone(const Vector3d& foot, double height, double radius_low, double radius_high) {
  return cone_solid({foot,
                     foot + Vector3d(0, 0, height),
                     Vector3d::UnitY(),
                     Vector3d::UnitX(),
                     {radius_low, radius_low},
                     {radius_high, radius_high},
                     Appearance::kTrunk});
}

StaticHit first_static_hit(const World& world, const Ray& ray) {
  StaticHit best{kSky, std::numeric_limits<double>::infinity()};
  if (ray.direction.z() < 0 && ray.origin.z() > 0)
    best = {kGround, -ray.origin.z() / ray.direction.z()};
  for (size_t i = 0; i < world.things.size(); ++i) {
    if (const auto found = entry(world.things[i], ray, best.distance))
      best = {static_cast<int>(i), *found};
  }
  return best;
}

double mirrored_share(const World& world, const Ray& ray) {
  constexpr double kUpright = 0.04;  // reflectance of vertical light: ((1.5 - 1) / (1.5 + 1))^2
  if (world.gloss == 0) return 0;
  const double grazing = 1 - std::min(1.0, std::abs(ray.direction.z()));
  return world.gloss * (kUpright + (1 - kUpright) * std::pow(grazing, 5));
}

Ray mirrored(const Ray& ray, double distance) {
  Ray out{ray.origin + distance * ray.direction, ray.direction};
  out.origin.z() = kShadowGap;
  out.direction.z() = std::abs(out.direction.z());
  return out;
}

namespace {

// Without the mirror image.
StaticLook look_of_surface(const World& world, const Ray& ray, const StaticHit& hit) {
  if (hit.thing == kSky) {
    const float height = static_cast<float>(std::max(0.0, ray.direction.z()));
    return {world.horizon + std::min(1.0f, 2 * height) * (world.zenith - world.horizon), 0};
  }
  const Vector3d point = ray.origin + hit.distance * ray.direction;
  const Vector3d sun = towards_sun(world.light);
  Vector3d normal = Vector3d::UnitZ();
  const Material* material = &world.ground;
  if (hit.thing != kGround) {
    const Thing& thing = world.things[static_cast<size_t>(hit.thing)];
    normal = normal_at(thing, point);
    material = &thing.material;
  }
  double lit = world.light.sun * std::max(0.0, normal.dot(sun));
  if (world.light.shadows && lit > 0 && in_static_shadow(world, point, sun)) lit = 0;
  const double brightness = world.light.ambient + lit;
  return {colour_at(*material, point, world.noise) * static_cast<float>(brightness),
          static_cast<float>(lit / brightness)};
}

}  // namespace

StaticLook look_of(const World& world, const Ray& ray, const StaticHit& hit) {
  StaticLook out = look_of_surface(world, ray, hit);
  const double share = hit.thing == kGround ? mirrored_share(world, ray) : 0;
  if (share == 0) return out;
  const Ray up = mirrored(ray, hit.distance);
  const Colour image = look_of_surface(world, up, first_static_hit(world, up)).colour;
  const Colour own = static_cast<float>(1 - share) * out.colour;
  out.colour = own + static_cast<float>(share) * image;
  // Shadows remove light from the ground, not from its mirror image.
  out.shaded_share = own.sum() / out.colour.sum();
  return out;
}

}  // namespace synth
}  // namespace walktrack
