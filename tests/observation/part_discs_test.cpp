#include "observation/silhouette/part_discs.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The formula in observation/silhouette/capsules.h for one end, in world axes, with the camera's
// own project(): independent of the vector code.
struct PlainDisc {
  Vector2d centre;
  double radius;
};

std::optional<PlainDisc> plain_disc(const Camera& camera, const PosedPart& part, bool upper) {
  const Vector3d up = (part.upper - part.lower).normalized();
  const Vector3d end = upper ? part.upper : part.lower, outwards = upper ? up : Vector3d(-up);
  const CrossSection section = upper ? part.at_upper : part.at_lower;
  const Vector3d ray = end - camera_centre(camera), cross = ray.cross(up);
  const double side_view = std::min(1.0, cross.squaredNorm() / ray.squaredNorm() / 0.1);
  const Vector3d normal = cross.normalized();
  const double side_on = std::hypot(section.lateral * part.lateral.dot(normal),
                                    section.forward * part.forward.dot(normal));
  const double radius =
      side_view * side_on + (1 - side_view) * std::sqrt(section.lateral * section.forward);
  const double shift = std::max(-0.5 * (part.upper - part.lower).norm(),
                                0.5 * (section.lateral + section.forward) - radius);
  const Vector3d middle = end + shift * outwards;
  const auto centre = project(camera, middle), rim = project(camera, middle + radius * normal);
  if (!centre || !rim) return std::nullopt;
  return PlainDisc{*centre, (*rim - *centre).norm()};
}

void expect_plain_discs(const Camera& camera, std::span<const PosedPart> parts) {
  PartDiscs discs;
  find_discs(camera, parts, discs);
  for (size_t i = 0; i < parts.size(); ++i) {
    const auto lower = plain_disc(camera, parts[i], false),
               upper = plain_disc(camera, parts[i], true);
    ASSERT_EQ(discs.nearest[i] >= kMinDepth, lower && upper);
    if (!lower || !upper) continue;
    // Both round about a dozen times, in numbers up to some 1e4 px.
    const double small = 1e-9 * (1 + lower->centre.norm() + upper->centre.norm());
    EXPECT_NEAR(discs.lower.x[i], lower->centre.x(), small);
    EXPECT_NEAR(discs.lower.y[i], lower->centre.y(), small);
    EXPECT_NEAR(discs.lower.radius[i], lower->radius, small);
    EXPECT_NEAR(discs.upper.x[i], upper->centre.x(), small);
    EXPECT_NEAR(discs.upper.y[i], upper->centre.y(), small);
    EXPECT_NEAR(discs.upper.radius[i], upper->radius, small);
    EXPECT_NEAR(discs.depth[i], camera_point(camera, 0.5 * (parts[i].lower + parts[i].upper)).z(),
                1e-12);
  }
}

struct LensCase {
  const char* name;
  std::vector<double> distortion;
  bool fisheye = false;
};

TEST(FindDiscs, AgreesWithTheFormulaForEveryLens) {
  const LensCase lenses[] = {{"pinhole", {}},
                             {"polynomial", {-0.2, 0.05, 0.002, -0.003, 0.01}},
                             {"folding polynomial", {-0.9, 0, 0, 0}},
                             {"rational", {0.3, 0.1, 0.001, 0.002, 0.01, 0.5, 0.2, 0.03}},
                             {"fisheye", {0.02, -0.01, 0.003, -0.001}, true}};
  for (const LensCase& lens : lenses) {
    SCOPED_TRACE(lens.name);
    Rng rng(1, Purpose::kTest);
    for (int i = 0; i < 40; ++i) {
      const Body body = make_body(Subject{}, {.head = i % 2 == 0, .arms = i % 3 == 0});
      // From far, from near, and from among the limbs.
      const double distance = i % 4 == 0 ? draw(rng, 0.05, 0.6) : draw(rng, 1.5, 9);
      Camera camera = camera_at({draw(rng, -1, 1), -distance, draw(rng, 0.3, 2.5)},
                                {draw(rng, -1, 1), 0, 0.9}, draw(rng, 300, 900));
      set_distortion(camera, lens.distortion, lens.fisheye);
      expect_plain_discs(camera, posed(body, random_walking_pose(rng)));
    }
  }
}

TEST(FindDiscs, APartSeenEndOnIsAsWideAsItsSectionsArea) {
  const Camera camera = camera_at({0, -5, 1}, {0, 0, 1}, 600);
  const PosedPart part{{0, 0, 1},    {0, 0.4, 1},  {1, 0, 0},         {0, 0, 1},
                       {0.12, 0.05}, {0.12, 0.05}, Appearance::kTrunk};
  PartDiscs discs;
  find_discs(camera, std::vector{part}, discs);
  const double radius = std::sqrt(0.12 * 0.05);
  // Its disc is nearer to the camera by the half ellipsoid's height minus its radius.
  const double depth = 5 - (0.5 * (0.12 + 0.05) - radius);
  EXPECT_NEAR(discs.lower.radius[0], 600 * radius / depth, 1e-9);
  EXPECT_NEAR(discs.lower.x[0], camera.centre_px.x(), 1e-9);
  EXPECT_NEAR(discs.lower.y[0], camera.centre_px.y(), 1e-9);
}

TEST(FindDiscs, TakesAnyNumberOfPartsThatABodyHas) {
  Rng rng(3, Purpose::kTest);
  const PosedParts all =
      posed(make_body(Subject{}, {.head = true, .arms = true}), random_walking_pose(rng));
  for (size_t count = 0; count <= all.size(); ++count)
    expect_plain_discs(side_camera(), std::span(all).first(count));
  const std::vector<PosedPart> many(kMaxParts + 1, all[0]);
  PartDiscs discs;
  EXPECT_THROW(find_discs(side_camera(), many, discs), std::length_error);
}

}  // namespace
}  // namespace walktrack
