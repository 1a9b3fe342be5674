// One camera's view of the world: the rays of its pixels and the image of the empty scene, which
// are both computed once, and frames with walkers.
//
// A pixel's label, depth and flow are exact for the ray through its centre. Its colour is averaged
// over sub-pixel rays if neighbouring pixels see different surfaces. Walkers cast shadows on each
// other, themselves and the ground, but not on other objects.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "camera/camera.h"
#include "synth/world/figure.h"
#include "synth/world/solid.h"
#include "synth/world/world.h"

namespace walktrack {
inline namespace synth {

// A row-major image of the camera's size.
template <typename T>
struct Plane {
  int width = 0, height = 0;
  std::vector<T> values;

  Plane() = default;
  Plane(int w, int h, const T& value)
      : width(w), height(h), values(static_cast<size_t>(w) * static_cast<size_t>(h), value) {}
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }
  T& at(int x, int y) { return values[index(x, y)]; }
  const T& at(int x, int y) const { return values[index(x, y)]; }
};

struct View {
  Camera camera;
  Eigen::Vector3d centre;             // of projection, world
  Plane<Eigen::Vector3f> directions;  // unit, world; zero where the lens has no ray
  Plane<Colour> empty;                // the scene without walkers
  Plane<float> sun_share;             // share of the brightness that a walker's shadow removes
  Plane<float> ambient_share;         // share that walkers remove who block all ambient light
  Plane<float> static_distance;       // m along the ray to an object or the ground; infinite for
                                      // the sky
  Plane<int> static_thing;            // kGround, kSky or an index of World::things
};

View make_view(const World& world, const Camera& camera, int threads);

// A walker at one time.
struct DressedParts {
  std::vector<ConeSolid> solids;
  std::vector<Appearance> appearance;  // of each
  const Clothes* clothes;
};

DressedParts dress(std::span<const PosedPart> parts, const Clothes& clothes);

// What the ray through a pixel's centre hits.
struct Sight {
  int16_t walker = -1;  // index, or -1: the empty scene
  int16_t part = -1;
  float distance = 0;  // m along the ray
};

struct Picture {
  Plane<Colour> colour;
  Plane<Sight> sights;
};

Picture render(const View& view, const World& world, std::span<const DressedParts> walkers);

// Depth (z of camera axes, m; infinite for the sky) of every pixel.
Plane<float> depth_of(const View& view, const Plane<Sight>& sights);

// Optical flow (px) of every pixel from these walkers to the positions of the same points in
// `next`; zero for the empty scene, NaN if the point leaves the camera's field of view.
Plane<Eigen::Vector2f> flow_of(const View& view, const Plane<Sight>& sights,
                               std::span<const DressedParts> now,
                               std::span<const DressedParts> next);

// 0 for the empty scene, otherwise 1 + index of the part + 100 * walker, at most 255.
Plane<uint8_t> labels_of(const Plane<Sight>& sights);

}  // namespace synth
}  // namespace walktrack
