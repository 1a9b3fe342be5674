#include "observation/silhouette/silhouette.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;

// Planes of multiples of 1/256 nat, so that clipping and rounding change nothing.
LogRatioPlanes random_planes(Rng& rng, const PixelRect& area, int count) {
  LogRatioPlanes planes;
  resize(planes, area, count);
  for (int a = 0; a < kAppearanceCount; ++a) planes.plane_of[static_cast<size_t>(a)] = a % count;
  std::vector<float> row(static_cast<size_t>(area.width()));
  for (int y = area.y0; y < area.y1; ++y) {
    for (int plane = 0; plane < count; ++plane) {
      for (float& value : row) value = static_cast<float>(std::floor(draw(rng, -800, 800))) / 256;
      set_row(planes, plane, y, row, 4);
    }
  }
  return planes;
}

// One pixel at a time, nearest capsule first: no rows, no prefix sums, no intervals.
double brute_force(const LogRatioPlanes& planes, const CapsuleList& capsules) {
  double sum = 0;
  for (int y = planes.area.y0; y < planes.area.y1; ++y) {
    for (int x = planes.area.x0; x < planes.area.x1; ++x) {
      for (const Capsule& capsule : capsules) {
        if (!inside(capsule, Vector2d(x, y))) continue;
        sum += log_ratio_at(planes, capsule.appearance, x, y);
        break;
      }
    }
  }
  return sum;
}

Disc random_disc(Rng& rng, double reach) {
  return {{draw(rng, -reach, 60 + reach), draw(rng, -reach, 90 + reach)}, draw(rng, 0.1, 20)};
}

CapsuleList random_capsules(Rng& rng, int count, double reach) {
  CapsuleList out;
  for (int i = 0; i < count; ++i) {
    const auto appearance =
        static_cast<Appearance>(std::min(4, static_cast<int>(draw(rng, 0, kAppearanceCount))));
    out.insert({random_disc(rng, reach), random_disc(rng, reach), draw(rng, 1, 9), appearance, i});
  }
  return out;
}

TEST(Silhouette, EqualsTheSumOverPixelsForRandomCapsules) {
  Rng rng(1, Purpose::kTest);
  const LogRatioPlanes planes = random_planes(rng, {3, 5, 50, 75}, 3);
  for (int i = 0; i < 1500; ++i) {
    const double reach = i % 3 == 0 ? 200 : 10;  // a third is partly or completely outside
    const CapsuleList capsules = random_capsules(rng, 1 + i % 15, reach);
    ASSERT_EQ(silhouette_log_ratio(planes, capsules), brute_force(planes, capsules)) << i;
  }
}

TEST(Silhouette, EqualsTheSumOverPixelsForRandomBodiesAndLenses) {
  Rng rng(2, Purpose::kTest);
  const Body body = make_body(Subject{}, {.head = true, .arms = true});
  const LogRatioPlanes planes = random_planes(rng, {0, 0, 24, 18}, 5);
  int seen = 0, empty = 0;
  for (int lens = 0; lens < 200; ++lens) {
    Camera camera = camera_at({0, -4, 1}, {0, 0, 1}, draw(rng, 12, 38), 24, 18);
    const double distortion[] = {draw(rng, -0.3, 0.2), draw(rng, -0.1, 0.1), draw(rng, -0.01, 0.01),
                                 draw(rng, -0.01, 0.01)};
    set_distortion(camera, distortion);
    for (int i = 0; i < 50; ++i) {
      // From all sides; some are so near that parts or all of the body are behind the camera, and
      // some look elsewhere.
      const Camera view = camera_at({draw(rng, -3, 3), draw(rng, -5, 0.5), draw(rng, 0.5, 3)},
                                    {draw(rng, -2, 2), 0.6, draw(rng, 0.3, 1.4)}, 20, 24, 18);
      camera.rotation = view.rotation;
      camera.translation = view.translation;
      const CapsuleList capsules = project_parts(camera, posed(body, random_walking_pose(rng)));
      const double sum = silhouette_log_ratio(planes, capsules);
      seen += sum != 0;
      empty += capsules.size() < body.parts.size();
      ASSERT_EQ(sum, brute_force(planes, capsules)) << lens << ", " << i;
    }
  }
  EXPECT_GT(seen, 5000);
  EXPECT_GT(empty, 100) << "no part was ever behind the camera";
}

TEST(Silhouette, DegenerateCapsules) {
  Rng rng(3, Purpose::kTest);
  const LogRatioPlanes planes = random_planes(rng, {0, 0, 40, 30}, 1);
  const auto sum_of = [&](const Disc& a, const Disc& b) {
    CapsuleList list;
    list.insert({a, b, 1, Appearance::kLegs, 0});
    EXPECT_EQ(silhouette_log_ratio(planes, list), brute_force(planes, list));
    return silhouette_log_ratio(planes, list);
  };
  const double whole = sum_of({{20, 15}, 100}, {{20, 15}, 100});
  EXPECT_EQ(sum_of({{-1e9, 15}, 10}, {{1e9, 15}, 100}), whole) << "a level capsule of any length";
  EXPECT_EQ(sum_of({{-5, 15}, 4.9}, {{-5, 3}, 4.9}), 0) << "left of the image";
  EXPECT_EQ(sum_of({{20, 1e12}, 5}, {{21, 1e12}, 5}), 0) << "far below the image";
  EXPECT_EQ(sum_of({{10.5, 10.5}, 0.4}, {{10.5, 10.5}, 0.4}), 0) << "between pixel centres";
  sum_of({{10, 10}, 0}, {{20, 10}, 0});  // a line through pixel centres
  sum_of({{10, 10}, 8}, {{12, 11}, 1});  // one disc inside the other
  EXPECT_EQ(silhouette_log_ratio(planes, CapsuleList{}), 0);
  EXPECT_EQ(silhouette_log_ratio(LogRatioPlanes{}, random_capsules(rng, 3, 0)), 0);
}

TEST(Silhouette, VisibleRunsCoverEachPixelOnceWithTheNearestCapsule) {
  Rng rng(4, Purpose::kTest);
  const PixelRect area{2, 3, 58, 85};
  for (int i = 0; i < 50; ++i) {
    const CapsuleList capsules = random_capsules(rng, 8, 15);
    std::set<std::pair<int, int>> covered;
    for (const VisibleRun& run : visible_runs(area, capsules)) {
      for (int x = run.x0; x < run.x1; ++x) {
        EXPECT_TRUE(covered.insert({x, run.y}).second);
        for (int k = 0; k < run.capsule; ++k)
          EXPECT_FALSE(inside(capsules[static_cast<size_t>(k)], Vector2d(x, run.y)));
        EXPECT_TRUE(inside(capsules[static_cast<size_t>(run.capsule)], Vector2d(x, run.y)));
      }
    }
  }
}

}  // namespace
}  // namespace walktrack
