#include "tracker/detect/keypoint_lines.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "tests/tracker/frame_time.h"
#include "tests/tracker/side_camera.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHeight = 1.7;

// Left and right slightly apart, as for a person who walks along x.
KeypointEvidence::Person standing(const Camera& camera, const Vector2d& place, Rng& rng,
                                  double noise_px) {
  KeypointEvidence::Person out;
  const auto put = [&](PointKind kind, double share) {
    for (const double side : {-1.0, 1.0}) {
      const size_t i = 2 * static_cast<size_t>(kind) - 1 + (side > 0);
      const auto px =
          project(camera, {place.x() + 0.05 * side, place.y() - 0.08 * side, share * kHeight});
      out[i].px = px.value() + noise_px * Vector2d(rng.normal(), rng.normal());
      out[i].precision = 1;
    }
  };
  put(PointKind::kShoulder, 0.80);
  put(PointKind::kHip, 0.52);
  put(PointKind::kAnkle, 0.06);
  return out;
}

TEST(PlaceOf, IsWhereThePersonStands) {
  Rng rng(1, Purpose::kTest);
  const Camera camera = side_camera(1.3);
  for (const Vector2d& place : {Vector2d(0, 0), Vector2d(-1.5, 2), Vector2d(2, 4)}) {
    const auto found = place_of(standing(camera, place, rng, 0), camera, kHeight);
    ASSERT_TRUE(found);
    EXPECT_LT((*found - place).norm(), 0.02);
  }
}

// For a person on a roof no place on the ground gives the right height.
TEST(PlaceOf, IsNoWhereForAPersonOnARoof) {
  Rng rng(1, Purpose::kTest);
  const Camera camera = side_camera(1.3);
  KeypointEvidence::Person person = standing(camera, {0, 4}, rng, 0);
  for (auto& point : person) point.px.y() -= 90;
  EXPECT_FALSE(place_of(person, camera, kHeight));
}

TEST(PlaceOf, NeedsTheAnkles) {
  Rng rng(1, Purpose::kTest);
  const Camera camera = side_camera(1.3);
  KeypointEvidence::Person person = standing(camera, {0, 0}, rng, 0);
  person[11].precision = person[12].precision = 0;
  EXPECT_FALSE(place_of(person, camera, kHeight));
}

// Two people, one walking and one standing, in random order, with noise and outliers.
TEST(KeypointLines, FollowEachPerson) {
  Rng rng(3, Purpose::kTest);
  const Camera camera = side_camera(1.3);
  const Vector2d start(-1.2, 0.5), velocity(1.25, 0.1), other(1, 3.5);
  std::vector<KeypointEvidence> frames(36);
  for (size_t i = 0; i < frames.size(); ++i) {
    const Vector2d place = start + double(i) * kDt * velocity;
    frames[i].people = {standing(camera, place, rng, 2), standing(camera, other, rng, 2)};
    if (i % 2) std::swap(frames[i].people[0], frames[i].people[1]);
    if (i % 9 == 4) frames[i].people.clear();
  }
  std::vector<const KeypointEvidence*> window;
  for (const KeypointEvidence& frame : frames) window.push_back(&frame);
  const auto lines = keypoint_lines(window, camera, kHeight, kDt, 0.5);
  ASSERT_EQ(lines.size(), 2u);
  const KeypointLine& walker = lines[0].velocity.norm() > 0.6 ? lines[0] : lines[1];
  const KeypointLine& standing_one = lines[0].velocity.norm() > 0.6 ? lines[1] : lines[0];
  EXPECT_LT((walker.velocity - velocity).norm(), 0.1);
  EXPECT_LT((walker.position - start).norm(), 0.1);
  EXPECT_LT(standing_one.velocity.norm(), 0.2);
  EXPECT_LT((standing_one.position - other).norm(), 0.2);
}

TEST(KeypointLines, AreNoneOfAMoment) {
  Rng rng(3, Purpose::kTest);
  const Camera camera = side_camera(1.3);
  KeypointEvidence frame;
  frame.people = {standing(camera, {0, 0}, rng, 0)};
  const std::vector<const KeypointEvidence*> window(3, &frame);
  EXPECT_TRUE(keypoint_lines(window, camera, kHeight, kDt, 0.5).empty());
}

}  // namespace
}  // namespace walktrack
