#include "tracker/walk_prior.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "fixture.h"
#include "tests/tracker/frame_time.h"
#include "tracker/moves/mirror_legs.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;

TEST(WalkingDirections, AreThoseOfTheSecondAroundAFrame) {
  std::vector<Vector2d> places;
  for (int t = 0; t < 90; ++t) {  // a circle with a radius of 2 m, at 1.2 m/s
    const double angle = 0.6 * kDt * t;
    places.emplace_back(2 * std::cos(angle), 2 * std::sin(angle));
  }
  const auto found = walking_directions(places, kDt);
  ASSERT_EQ(found.size(), places.size());
  for (size_t t = 0; t < places.size(); ++t) {
    ASSERT_TRUE(found[t]) << t;
    EXPECT_NEAR(found[t]->norm(), 1, 1e-12);
    // The chord of a circle is parallel to the tangent half-way; at the ends there is half of it.
    const size_t before = t < 15 ? 0 : t - 15, after = std::min<size_t>(t + 15, 89);
    const double middle = 0.3 * kDt * double(before + after);
    EXPECT_NEAR(std::atan2(found[t]->y(), found[t]->x()), std::remainder(middle + kPi / 2, 2 * kPi),
                1e-9)
        << t;
  }
}

TEST(WalkingDirections, WhoStandsHasNone) {
  std::vector<Vector2d> places;
  for (int t = 0; t < 30; ++t) places.emplace_back(0.29 * kDt * t, 0);
  for (const WalkingDirection& each : walking_directions(places, kDt)) EXPECT_FALSE(each);
  for (Vector2d& place : places) place *= 0.31 / 0.29;
  for (const WalkingDirection& each : walking_directions(places, kDt)) EXPECT_TRUE(each);
  EXPECT_TRUE(walking_directions({}, kDt).empty());
  EXPECT_FALSE(walking_directions(std::span(places).first(1), kDt).at(0));
}

Pose stepping(const Body& body) {
  Pose pose;
  pose.root = {1, 2, leg_length(body.lengths) - 0.05};
  pose.heading = 0.4;
  pose.legs[0] = {0.4, 0.06, 0.1, 0.3, 0.1};
  pose.legs[1] = {-0.2, -0.02, 0, 0.5, 0};
  return pose;
}

LegsAside legs_aside(const Body& body, const Pose& pose, double direction) {
  return walktrack::legs_aside(forward_kinematics(body, pose).joints, body.subject.height,
                               Vector2d(std::cos(direction), std::sin(direction)));
}

// By hand: distances from the line through the pelvis in the direction of the walk.
TEST(LegsAside, AreDistancesFromTheLineOfTheWalk) {
  const Body body = test_model().body;
  const Pose pose = stepping(body);
  const double direction = 0.3, stature = body.subject.height;
  const LegsAside found = legs_aside(body, pose, direction);
  const JointPositions joints = forward_kinematics(body, pose).joints;
  const Eigen::Rotation2Dd back(-direction);
  const auto to_left = [&](Joint joint) {
    return (back * (joints[joint] - pose.root).head<2>()).y() / stature;
  };
  EXPECT_NEAR(found[0], (to_left(Joint::kLeftKnee) - .044) / .020, 1e-9);
  EXPECT_NEAR(found[1], (-to_left(Joint::kRightKnee) - .044) / .020, 1e-9);
  EXPECT_NEAR(found[2], (to_left(Joint::kLeftAnkle) - .022) / .026, 1e-9);
  EXPECT_NEAR(found[3], (-to_left(Joint::kRightAnkle) - .022) / .026, 1e-9);
}

// Laws: the whole turned, or moved, is the same; its mirror image has left and right swapped.
TEST(LegsAside, TurnWithTheWalkAndAreSwappedByAMirror) {
  const Body body = test_model().body;
  const Pose pose = stepping(body);
  const LegsAside found = legs_aside(body, pose, 0.3);
  Pose turned = pose;
  turned.heading += 2;
  turned.root.head<2>() = Vector2d(-3, 5);
  EXPECT_LT((legs_aside(body, turned, 2.3) - found).norm(), 1e-9);
  Pose mirrored = pose;
  mirrored.heading *= -1;
  mirrored.list *= -1;
  std::swap(mirrored.legs[0], mirrored.legs[1]);
  const LegsAside swapped = legs_aside(body, mirrored, -0.3);
  EXPECT_LT((swapped - LegsAside(found[1], found[0], found[3], found[2])).norm(), 1e-9);
}

// People's legs are as likely on either side of the mean: an upright body that is made for the
// tables' mean has its knees within a standard deviation.
TEST(LegsAside, LegsThatHangDownAreUsual) {
  const Body body = test_model().body;
  Pose pose;
  pose.root.z() = leg_length(body.lengths);
  const LegsAside found = legs_aside(body, pose, 0);
  EXPECT_LT(found.cwiseAbs().maxCoeff(), 1.5);
}

}  // namespace
}  // namespace walktrack
