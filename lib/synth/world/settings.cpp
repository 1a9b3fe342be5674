#include "synth/world/settings.h"

#include <algorithm>
#include <cmath>

#include "core/conventions.h"
#include "core/rng.h"

namespace walktrack {
inline namespace synth {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRoomHeight = 3.2;     // m
constexpr uint32_t kPlacement = 0x5e7;  // streams for the positions of objects, distinct from those
                                        // of noise

double between(Rng& rng, double low, double high) { return low + (high - low) * rng.uniform(); }

Colour random_colour(Rng& rng, double low, double high) {
  return Colour(static_cast<float>(between(rng, low, high)),
                static_cast<float>(between(rng, low, high)),
                static_cast<float>(between(rng, low, high)));
}

void add_box(World& world, const Vector3d& low, const Vector3d& high, const Material& material,
             bool casts_shadow) {
  world.things.push_back({BoxSolid{low, high}, material, casts_shadow});
}

// Adds a box given by its extent along one wall (from, to), its distance from the wall and its
// height. `wall` 0 … 3 counts from +x by quarter turns; `half` is the half width of the room.
void add_at_wall(World& world, const Vector2d& centre, double half, int wall, double from,
                 double to, double depth_from, double depth_to, double bottom, double top,
                 const Material& material) {
  const bool along_y = wall % 2 == 0;
  const double sign = wall < 2 ? 1 : -1;
  const double near = sign * (half - depth_to), far = sign * (half - depth_from);
  const double a = std::min(near, far), b = std::max(near, far);
  const Vector3d middle(centre.x(), centre.y(), 0);
  const Vector3d low = along_y ? Vector3d(a, from, bottom) : Vector3d(from, a, bottom);
  const Vector3d high = along_y ? Vector3d(b, to, top) : Vector3d(to, b, top);
  // Walls would block a sun that represents a lamp, so that objects at walls cast no shadows.
  add_box(world, middle + low, middle + high, material, false);
}

void furnish_wall(World& world, const Vector2d& centre, double half, int wall, uint64_t seed) {
  Rng rng(seed, Purpose::kRendering, kPlacement, static_cast<uint32_t>(wall));
  for (double at = -half + 0.4; at < half - 1.5;) {
    const double width = between(rng, 0.5, 1.4);
    const bool picture = rng.uniform() < 0.6;
    const Material material{random_colour(rng, 0.15, 0.8), random_colour(rng, 0.15, 0.8),
                            rng.uniform() < 0.4 ? Pattern::kStripes : Pattern::kMottled,
                            between(rng, 0.12, 0.35)};
    const double bottom = picture ? between(rng, 0.9, 1.5) : 0;
    const double top = picture ? bottom + between(rng, 0.5, 1.1) : between(rng, 0.4, 1.9);
    add_at_wall(world, centre, half, wall, at, at + width, 0, picture ? 0.03 : 0.45, bottom, top,
                material);
    at += width + between(rng, 0.15, 1.0);
  }
}

void build_room(World& world, const Vector2d& centre, double reach, uint64_t seed) {
  world.ground = {Colour(0.62f, 0.47f, 0.32f), Colour(0.36f, 0.25f, 0.16f), Pattern::kPlanks, 0.14};
  world.horizon = world.zenith = Colour(0.8f, 0.8f, 0.78f);
  const double half = reach + 1;
  const Material paint{Colour(0.78f, 0.76f, 0.68f), Colour(0.6f, 0.58f, 0.52f), Pattern::kMottled,
                       0.7};
  const Material skirting{Colour(0.35f, 0.3f, 0.26f), Colour(0.3f, 0.26f, 0.22f), Pattern::kPlain,
                          0.1};
  for (int wall = 0; wall < 4; ++wall) {
    add_at_wall(world, centre, half, wall, -half - 1, half + 1, -0.2, 0, 0, kRoomHeight, paint);
    add_at_wall(world, centre, half, wall, -half, half, 0, 0.02, 0, 0.12, skirting);
    furnish_wall(world, centre, half, wall, seed);
  }
}

void add_tree(World& world, const Vector3d& foot, Rng& rng) {
  const double height = between(rng, 1.6, 3.0), radius = between(rng, 0.10, 0.22);
  const Material bark{Colour(0.36f, 0.27f, 0.2f), Colour(0.2f, 0.15f, 0.11f), Pattern::kMottled,
                      0.08};
  world.things.push_back({upright_cone(foot, height, radius, 0.8 * radius), bark, true});
  const double crown = between(rng, 0.8, 1.5);
  const float green = static_cast<float>(between(rng, 0.3, 0.45));
  const Material leaves{Colour(0.6f * green, green, 0.4f * green),
                        Colour(0.3f * green, 0.5f * green, 0.2f * green), Pattern::kMottled, 0.16};
  world.things.push_back(
      {upright_cone(foot + Vector3d(0, 0, height + 0.5 * crown), 0.8 * crown, crown, 0.7 * crown),
       leaves, true});
}

void build_field(World& world, const Vector2d& centre, double reach, uint64_t seed) {
  world.ground = {Colour(0.42f, 0.5f, 0.27f), Colour(0.28f, 0.33f, 0.17f), Pattern::kMottled, 0.18};
  for (uint32_t i = 0; i < 26; ++i) {
    Rng rng(seed, Purpose::kRendering, kPlacement, 16 + i);
    const double angle = 2 * kPi * (i + 0.7 * rng.uniform()) / 26;
    const double distance = reach + between(rng, 2.5, 9);
    add_tree(world,
             {centre.x() + distance * std::cos(angle), centre.y() + distance * std::sin(angle), 0},
             rng);
  }
}

}  // namespace

World make_world(Setting setting, const Vector2d& centre, double reach, const Light& light,
                 uint64_t seed) {
  World world;
  world.light = light;
  world.noise = Noise(seed);
  switch (setting) {
    case Setting::kRoom:
      build_room(world, centre, reach, seed);
      break;
    case Setting::kField:
      build_field(world, centre, reach, seed);
      break;
    case Setting::kStudio:
      world.ground = {Colour(0.5f, 0.5f, 0.5f), Colour(0.44f, 0.44f, 0.44f), Pattern::kChecks, 0.5};
      break;
  }
  return world;
}

}  // namespace synth
}  // namespace walktrack
