#include "observation/silhouette/capsules.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Points densely on the surface of the solid that body/body.h describes, an elliptic cone and half
// ellipsoids, computed independently.
std::vector<Vector3d> surface(const PosedPart& part) {
  constexpr int kRound = 48, kAlong = 24, kCap = 12;
  std::vector<Vector3d> points;
  const Vector3d axis = (part.upper - part.lower).normalized();
  for (int i = 0; i < kRound; ++i) {
    const double a = 2 * kPi * i / kRound, c = std::cos(a), s = std::sin(a);
    const auto ring = [&](const CrossSection& r, double share) -> Vector3d {
      return share * (c * r.lateral * part.lateral + s * r.forward * part.forward);
    };
    for (int k = 0; k <= kAlong; ++k) {
      const double t = static_cast<double>(k) / kAlong;
      points.push_back(part.lower + t * (part.upper - part.lower) +
                       (1 - t) * ring(part.at_lower, 1) + t * ring(part.at_upper, 1));
    }
    for (int k = 1; k <= kCap; ++k) {
      const double e = 0.5 * kPi * k / kCap, up = std::sin(e), out = std::cos(e);
      const auto bulge = [&](const CrossSection& r) { return 0.5 * up * (r.lateral + r.forward); };
      points.push_back(part.upper + bulge(part.at_upper) * axis + ring(part.at_upper, out));
      points.push_back(part.lower - bulge(part.at_lower) * axis + ring(part.at_lower, out));
    }
  }
  return points;
}

// The largest distance between the outlines of the solid's image and of the capsule in any of 64
// directions of the image.
double outline_error(const Camera& camera, const PosedPart& part, const Capsule& capsule) {
  double worst = 0;
  const std::vector<Vector3d> points = surface(part);
  for (int i = 0; i < 64; ++i) {
    const double a = 2 * kPi * i / 64;
    const Vector2d direction(std::cos(a), std::sin(a));
    double solid = -1e9;
    for (const Vector3d& point : points)
      solid = std::max(solid, direction.dot(*project(camera, point)));
    const double flat = std::max(direction.dot(capsule.lower.centre) + capsule.lower.radius,
                                 direction.dot(capsule.upper.centre) + capsule.upper.radius);
    worst = std::max(worst, std::abs(solid - flat));
  }
  return worst;
}

PosedPart round_part(const Vector3d& lower, const Vector3d& upper, double radius) {
  const Vector3d axis = (upper - lower).normalized();
  const Vector3d lateral = axis.unitOrthogonal();
  return {lower,
          upper,
          lateral,
          axis.cross(lateral),
          {radius, radius},
          {radius, radius},
          Appearance::kLegs};
}

TEST(ProjectParts, RoundPartsSeenFromTheSideAreExact) {
  const Camera camera = side_camera();
  const PosedPart part = round_part({0.1, 0, 0.5}, {-0.1, 0.05, 0.9}, 0.06);
  const CapsuleList capsules = project_parts(camera, std::vector{part});
  ASSERT_EQ(capsules.size(), 1U);
  // A sphere in perspective is r / sqrt(d^2 - r^2) wide, not r / d: 0.005 % here, and the surface
  // is sampled every 7.5 degrees, which loses up to 0.2 % of 6.7 px.
  EXPECT_LT(outline_error(camera, part, capsules[0]), 0.03);
}

// The statement in the header: the error of capsules for the elliptic solids, over poses and views.
TEST(ProjectParts, OutlinesOfTheBodyFitItsSolids) {
  Rng rng(1, Purpose::kTest);
  const Body body = make_body(Subject{}, {.head = true, .arms = true});
  std::vector<double> errors_px;
  for (int i = 0; i < 60; ++i) {
    const double around = draw(rng, -kPi, kPi);
    const Camera camera =
        camera_at({6 * std::sin(around), -6 * std::cos(around), draw(rng, 1, 3)}, {0, 0, 0.9}, 672);
    const PosedParts parts = posed(body, random_walking_pose(rng));
    for (const Capsule& capsule : project_parts(camera, parts))
      errors_px.push_back(outline_error(camera, parts[static_cast<size_t>(capsule.part)], capsule));
  }
  std::sort(errors_px.begin(), errors_px.end());
  const auto quantile = [&](double q) {
    return errors_px[static_cast<size_t>(q * static_cast<double>(errors_px.size() - 1))];
  };
  RecordProperty("median_px", std::to_string(quantile(0.5)));
  RecordProperty("p95_px", std::to_string(quantile(0.95)));
  RecordProperty("largest_px", std::to_string(quantile(1)));
  // A figure about 190 px high, 9 mm per pixel: the margins over the measured values (0.10, 1.04
  // and 2.20 px) are for other random poses.
  EXPECT_LT(quantile(0.5), 0.15);
  EXPECT_LT(quantile(0.95), 1.3);
  EXPECT_LT(quantile(1), 2.8);
}

TEST(ProjectParts, ScalesAndMovesWithTheLens) {
  Camera camera = side_camera();
  const PosedPart part = round_part({1.8, 0, 0.5}, {1.8, 0, 0.9}, 0.06);
  const Capsule plain = project_parts(camera, std::vector{part})[0];
  const double distortion[] = {-0.2, 0.05, 0, 0};
  set_distortion(camera, distortion);
  const Capsule bent = project_parts(camera, std::vector{part})[0];
  EXPECT_LT(bent.lower.centre.x(), plain.lower.centre.x() - 1);
  EXPECT_LT(bent.lower.radius, 0.99 * plain.lower.radius);
  // Straight lines bend by this much between the two ends, in addition to the error without a lens.
  EXPECT_LT(outline_error(camera, part, bent), 0.1);
}

TEST(ProjectParts, LeavesOutWhatReachesBehindTheCamera) {
  const Camera camera = side_camera();
  const std::vector<PosedPart> parts{round_part({0, 0, 0.5}, {0, 0, 0.9}, 0.06),
                                     round_part({0, -5.9, 1.4}, {0, -6.1, 1.4}, 0.06),
                                     round_part({0, -9, 1}, {0, -9, 1.3}, 0.06)};
  const CapsuleList capsules = project_parts(camera, parts);
  ASSERT_EQ(capsules.size(), 1U);
  EXPECT_EQ(capsules[0].part, 0);
}

TEST(ProjectParts, SortsByDepth) {
  Rng rng(2, Purpose::kTest);
  const Body body = make_body(Subject{}, {.head = true, .arms = true});
  for (int i = 0; i < 20; ++i) {
    const CapsuleList capsules =
        project_parts(side_camera(), posed(body, random_walking_pose(rng)));
    ASSERT_EQ(capsules.size(), body.parts.size());
    EXPECT_TRUE(std::is_sorted(capsules.begin(), capsules.end(),
                               [](const auto& a, const auto& b) { return a.depth < b.depth; }));
  }
}

TEST(ProjectParts, EndOnRadiiChangeWithoutAJump) {
  const Camera camera = side_camera();
  // A flat part turned through the line of sight (the y axis): wide across x, thin across z.
  double before = 0;
  for (int i = -100; i <= 100; ++i) {
    const double a = 1e-2 * i;
    const Vector3d axis(0, std::cos(a), std::sin(a));
    const PosedPart part{{0, 0, 1.5},       Vector3d(0, 0, 1.5) + 0.3 * axis,
                         {1, 0, 0},         {0, -std::sin(a), std::cos(a)},
                         {0.15, 0.08},      {0.15, 0.08},
                         Appearance::kTrunk};
    const double radius = project_parts(camera, std::vector{part})[0].lower.radius;
    if (i > -100) {
      EXPECT_NEAR(radius, before, 0.6) << a;  // 16.8 px sideways, 12.3 px end-on
    }
    before = radius;
  }
}

TEST(CapsuleList, RefusesMoreThanItHolds) {
  CapsuleList list;
  for (size_t i = 0; i < kMaxCapsules; ++i) list.insert({});
  EXPECT_THROW(list.insert({}), std::length_error);
}

}  // namespace
}  // namespace walktrack
