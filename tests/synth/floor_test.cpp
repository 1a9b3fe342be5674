// Floors that mirror, and ambient light that walkers block.
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "core/conventions.h"
#include "core/rng.h"
#include "synth/recording/view.h"
#include "synth/world/settings.h"
#include "tests/camera/made_camera.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;

Camera camera_from(const Vector3d& eye, const Vector3d& target) {
  return looking_at(lens({160, 120}, {160, 160}, {79.5, 59.5}), eye, target);
}

Ray ray_down(double degrees_below) {
  const double angle = rad_from_deg(degrees_below);
  return {{0, 0, 1}, {std::cos(angle), 0, -std::sin(angle)}};
}

PosedPart round_part(const Vector3d& centre, double radius) {
  const Vector3d half(0, 0, 5e-6);
  return {centre - half,    centre + half,    Vector3d::UnitY(), Vector3d::UnitX(),
          {radius, radius}, {radius, radius}, Appearance::kTrunk};
}

World floor_world(double gloss, bool contact_shadows) {
  Light light;
  light.shadows = false;
  light.contact_shadows = contact_shadows;
  World world = make_world(Setting::kStudio, {0, 0}, 5, light, 1);
  world.gloss = gloss;
  return world;
}

struct Shown {
  View view;
  Picture empty, with;
};

Shown shown(const World& world, const Camera& camera, const PosedPart& part) {
  const View view = make_view(world, camera, 1);
  const Clothes dressed = clothes(0);
  const std::vector<DressedParts> walkers{dress(std::span(&part, 1), dressed)};
  return {view, render(view, world, {}), render(view, world, walkers)};
}

// Fresnel's equations for unpolarised light on glass with the refractive index 1.5, from which
// Schlick's approximation differs by some thousandths up to 70 degrees from the vertical.
TEST(Floor, MirrorsAsFresnelSays) {
  const World world = floor_world(1, false);
  for (const double below : {90.0, 60.0, 40.0, 25.0}) {
    const double in = rad_from_deg(90 - below), out = std::asin(std::sin(in) / 1.5);
    const double s = (std::cos(in) - 1.5 * std::cos(out)) / (std::cos(in) + 1.5 * std::cos(out));
    const double p = (1.5 * std::cos(in) - std::cos(out)) / (1.5 * std::cos(in) + std::cos(out));
    EXPECT_NEAR(mirrored_share(world, ray_down(below)), 0.5 * (s * s + p * p), 0.02) << below;
  }
  EXPECT_NEAR(mirrored_share(world, ray_down(1e-6)), 1, 1e-6);
  EXPECT_EQ(mirrored_share(floor_world(0, false), ray_down(30)), 0);
  EXPECT_NEAR(mirrored_share(floor_world(0.5, false), ray_down(30)),
              0.5 * mirrored_share(world, ray_down(30)), 1e-12);
}

// The mirror image of a ball is the image of the ball that is as far below the ground.
TEST(Floor, MirrorImageIsWhereTheBallBelowTheGroundWouldBe) {
  const Camera camera = camera_from({0, -4, 1.4}, {0, 0, 0.3});
  const Vector3d centre(0.2, 0, 0.5);
  const Shown glossy = shown(floor_world(1, false), camera, round_part(centre, 0.15));
  // Pixels of the ball's own edge change on a matt floor, too.
  const Shown matt = shown(floor_world(0, false), camera, round_part(centre, 0.15));
  const Vector3d below(centre.x(), centre.y(), -centre.z());
  double changed = 0;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      if (glossy.with.sights.at(x, y).walker >= 0 ||
          matt.with.colour.at(x, y) != matt.empty.colour.at(x, y))
        continue;
      const bool mirrors =
          !glossy.with.colour.at(x, y).isApprox(glossy.empty.colour.at(x, y), 1e-4f);
      changed += mirrors;
      if (mirrors) middle += Eigen::Vector2d(x, y);
    }
  }
  ASSERT_GT(changed, 30);
  const auto expected = project(camera, below);
  ASSERT_TRUE(expected);
  EXPECT_LT((middle / changed - *expected).norm(), 1.0);
  const double radius_px = camera.focal_px.x() * 0.15 / camera_point(camera, below).z();
  EXPECT_NEAR(std::sqrt(changed / kPi), radius_px, 1.0);
}

TEST(Floor, MattOnesHaveNoMirrorImage) {
  const Camera camera = camera_from({0, -4, 1.4}, {0, 0, 0.3});
  const Shown matt = shown(floor_world(0, false), camera, round_part({0.2, 0, 0.5}, 0.15));
  for (size_t i = 0; i < matt.empty.colour.values.size(); ++i) {
    const bool ground = matt.with.sights.values[i].walker < 0;
    if (!ground || matt.with.colour.values[i] == matt.empty.colour.values[i]) continue;
    // Only the ball's own edge, which sub-pixel rays hit.
    EXPECT_LT(std::abs(static_cast<double>(i % 160) - 87), 12);
  }
}

// The ambient light that a ball blocks, by counting rays that leave the ground with a cosine
// distribution.
TEST(Floor, ContactShadowIsTheShareOfTheSkyThatIsHidden) {
  const double radius = 0.1;
  const Vector3d centre(0, 0, 0.16);
  const PosedPart ball = round_part(centre, radius);
  const ConeSolid solid = cone_solid(ball);
  const Camera camera = camera_from({0, -2, 2}, {0.25, 0, 0});
  const Shown dark = shown(floor_world(0, true), camera, ball);
  Rng rng(3, Purpose::kTest);
  for (const double x : {0.15, 0.25, 0.4}) {
    const Vector3d point(x, 0, 0);
    constexpr int kRays = 200'000;
    int hidden = 0;
    for (int i = 0; i < kRays; ++i) {
      const double turn = 2 * kPi * rng.uniform(), sine2 = rng.uniform();
      const Vector3d way(std::sqrt(sine2) * std::cos(turn), std::sqrt(sine2) * std::sin(turn),
                         std::sqrt(1 - sine2));
      hidden += entry_distance(solid, {point, way}, 10).has_value();
    }
    const auto pixel = project(camera, point);
    ASSERT_TRUE(pixel);
    const int px = static_cast<int>(std::lround(pixel->x()));
    const int py = static_cast<int>(std::lround(pixel->y()));
    ASSERT_LT(dark.with.sights.at(px, py).walker, 0);
    const double ambient = static_cast<double>(dark.view.ambient_share.at(px, py));
    const double kept = static_cast<double>(dark.with.colour.at(px, py).sum()) /
                        static_cast<double>(dark.empty.colour.at(px, py).sum());
    const double share = hidden / static_cast<double>(kRays);
    EXPECT_NEAR((1 - kept) / ambient, share, 0.02 + 0.05 * share) << x;
    EXPECT_GT(share, 0.01);
  }
}

}  // namespace
}  // namespace walktrack
