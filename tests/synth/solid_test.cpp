#include "synth/world/solid.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "core/conventions.h"
#include "core/rng.h"
#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;

Vector3d random_direction(Rng& rng) {
  return Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized();
}

PosedPart random_part(Rng& rng) {
  const Vector3d up = random_direction(rng);
  const Vector3d lateral = up.cross(random_direction(rng)).normalized();
  const Vector3d lower(draw(rng, -1, 1), draw(rng, -1, 1), draw(rng, -1, 1));
  // Feet: the axis is not at right angles to the cross-sections.
  const Vector3d lean = 0.1 * random_direction(rng);
  return {lower,
          lower + draw(rng, 0.1, 1) * (up + lean),
          lateral,
          lateral.cross(up),
          {draw(rng, 0.02, 0.3), draw(rng, 0.02, 0.3)},
          {draw(rng, 0.02, 0.3), draw(rng, 0.02, 0.3)},
          Appearance::kTrunk};
}

// The definition in the header, independent of the code under test: < 0 inside.
double implicit(const PosedPart& part, const Vector3d& point) {
  Eigen::Matrix3d basis;
  basis << part.forward, part.lateral, part.upper - part.lower;
  const Vector3d q = basis.colPivHouseholderQr().solve(point - part.lower);
  const double s = std::clamp(q.z(), 0.0, 1.0);
  const double a = (1 - s) * part.at_lower.forward + s * part.at_upper.forward;
  const double b = (1 - s) * part.at_lower.lateral + s * part.at_upper.lateral;
  const double cap = 0.5 * (a + b) / (part.upper - part.lower).norm();
  const double beyond = (q.z() - s) / cap;
  return std::pow(q.x() / a, 2) + std::pow(q.y() / b, 2) + beyond * beyond - 1;
}

Ray random_ray(Rng& rng, const PosedPart& part) {
  const Vector3d origin = 4 * random_direction(rng);
  const Vector3d target =
      0.5 * (part.lower + part.upper) + draw(rng, 0, 0.5) * random_direction(rng);
  return {origin, (target - origin).normalized()};
}

ConeSolid upright_cone_for_test() {
  return cone_solid({{0, 0, 0},
                     {0, 0, 1},
                     Vector3d::UnitY(),
                     Vector3d::UnitX(),
                     {0.2, 0.2},
                     {0.1, 0.1},
                     Appearance::kTrunk});
}

TEST(ConeSolid, EntryLiesOnTheSurfaceAndNothingBeforeIt) {
  Rng rng(1, Purpose::kTest);
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    const PosedPart part = random_part(rng);
    const ConeSolid solid = cone_solid(part);
    for (int k = 0; k < 5; ++k) {
      const Ray ray = random_ray(rng, part);
      const auto t = entry_distance(solid, ray, 100);
      const double end = t ? *t - 1e-6 : 8.0;
      for (double at = 1; at < end; at += 0.01)
        ASSERT_GT(implicit(part, ray.origin + at * ray.direction), 0);
      if (!t) continue;
      ++hits;
      // Rounding of 1e-15 over semi-axes of 0.02 and grazing angles.
      EXPECT_NEAR(implicit(part, ray.origin + *t * ray.direction), 0, 1e-8);
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(ConeSolid, NormalsAreTheGradientOfTheDefinition) {
  Rng rng(2, Purpose::kTest);
  int checked = 0;
  for (int i = 0; i < 300; ++i) {
    const PosedPart part = random_part(rng);
    const ConeSolid solid = cone_solid(part);
    const Ray ray = random_ray(rng, part);
    const auto t = entry_distance(solid, ray, 100);
    if (!t) continue;
    const Vector3d point = ray.origin + *t * ray.direction;
    const double s = local_point(solid, point).z();
    if (std::abs(s) < 1e-3 || std::abs(s - 1) < 1e-3) continue;  // the definition has an edge there
    Vector3d gradient;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Vector3d h = 1e-6 * Vector3d::Unit(axis);
      gradient[axis] = implicit(part, point + h) - implicit(part, point - h);
    }
    // Central differences: 1e-16 / 1e-6 of rounding against slopes of some 10 per metre.
    EXPECT_TRUE(
        surface_normal(solid, local_point(solid, point)).isApprox(gradient.normalized(), 1e-6));
    ++checked;
  }
  EXPECT_GT(checked, 80);
}

TEST(ConeSolid, LocalAndWorldPointsAreInverse) {
  Rng rng(3, Purpose::kTest);
  const ConeSolid solid = cone_solid(random_part(rng));
  const Vector3d point(0.3, -0.7, 1.1);
  EXPECT_TRUE(world_point(solid, local_point(solid, point)).isApprox(point, 1e-12));
}

TEST(ConeSolid, RespectsTheFarthestDistanceAndRaysAlongItsAxis) {
  const ConeSolid post = upright_cone_for_test();
  const Ray down{{0, 0, 5}, {0, 0, -1}};
  ASSERT_TRUE(entry_distance(post, down, 100).has_value());
  EXPECT_NEAR(*entry_distance(post, down, 100), 5 - 1 - 0.1, 1e-12);  // cap of radius 0.1 on top
  EXPECT_FALSE(entry_distance(post, down, 3.8).has_value());
  EXPECT_FALSE(entry_distance(post, {{0, 0, 5}, {0, 0, 1}}, 100).has_value());  // behind
}

TEST(BoxSolid, MeetsItsNearestFace) {
  const BoxSolid box{{-1, -2, 0}, {1, 2, 3}};
  const auto t = entry_distance(box, {{5, 0, 1}, {-1, 0, 0}}, 100);
  ASSERT_TRUE(t.has_value());
  EXPECT_DOUBLE_EQ(*t, 4);
  EXPECT_TRUE(surface_normal(box, {1, 0, 1}).isApprox(Vector3d::UnitX()));
  EXPECT_FALSE(entry_distance(box, {{5, 0, 4}, {-1, 0, 0}}, 100).has_value());
  EXPECT_FALSE(entry_distance(box, {{5, 0, 1}, {-1, 0, 0}}, 3).has_value());
}

}  // namespace
}  // namespace walktrack
