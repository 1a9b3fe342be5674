// The static world: ground z = 0, objects on it, sky, sun. Metres, radians.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "synth/world/material.h"
#include "synth/world/solid.h"

namespace walktrack {
inline namespace synth {

// One sun (or distant lamp) and ambient light from all directions. A lit white surface has the
// brightness ambient + sun * cos(angle of incidence).
struct Light {
  double azimuth = -1.0;   // of the sun, from world x towards y, rad
  double elevation = 0.9;  // above the horizon, rad
  double sun = 0.55;
  double ambient = 0.45;
  bool shadows = true;
  // Whether walkers block ambient light, too, on the ground near them: soft contact shadows.
  bool contact_shadows = false;
};

inline constexpr double kShadowGap = 1e-4;  // m; prevents that a surface shades itself by rounding

Eigen::Vector3d towards_sun(const Light& light);

// An object in the scene.
struct Thing {
  std::variant<BoxSolid, ConeSolid> solid;
  Material material;
  bool casts_shadow = true;
};

// A post: a vertical elliptic cone, for trunks and pillars.
ConeSolid upright_cone(const Eigen::Vector3d& foot, double height, double radius_low,
                       double radius_high);

struct World {
  Material ground;
  // Gloss of the ground, from 0 matt to 1 polished: the share that it shows of a polished surface's
  // mirror image (mirrored_share).
  double gloss = 0;
  Colour horizon{0.75f, 0.8f, 0.85f}, zenith{0.45f, 0.6f, 0.8f};
  std::vector<Thing> things;
  Light light;
  Noise noise{1};
};

// The first hit of a ray.
struct StaticHit {
  int thing;        // index into things; kGround or kSky
  double distance;  // m; infinite for the sky
};
inline constexpr int kGround = -1, kSky = -2;

StaticHit first_static_hit(const World& world, const Ray& ray);

// Albedo at the point that a ray hits, and the share of the sun's light that falls on the surface
// there (0 in the shadow of an object). The sky has a colour of its own and no light on it.
struct StaticLook {
  Colour colour;    // lit
  float sun_share;  // share of the surface's brightness due to the sun, which an additional shadow
                    // removes
  float shaded_share = 1;  // share of the colour that is the surface's own, not its mirror image
};
StaticLook look_of(const World& world, const Ray& ray, const StaticHit& hit);

// Share of the ground's mirror image in what a ray shows, by Schlick's approximation (An
// inexpensive BRDF model for physically-based rendering, 1994) of Fresnel's law for the refractive
// index 1.5.
double mirrored_share(const World& world, const Ray& ray);
// The reflected ray from the point at which `ray` hits the ground, at that distance.
Ray mirrored(const Ray& ray, double distance);

}  // namespace synth
}  // namespace walktrack
