#include "kinetics/ground_contact.h"

#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/rng.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const std::vector<FootContact> kWalk{
    {Side::kLeft, 0, 0.7}, {Side::kRight, 0.5, 1.3}, {Side::kLeft, 1.1, 1.8}};

TEST(LoadShares, GoFromFootToFootWithoutAStep) {
  double last = 1;
  for (double t = 0; t < 1.75; t += 0.001) {
    const auto shares = load_shares(kWalk, t);
    ASSERT_TRUE(shares);
    EXPECT_EQ(shares->of[0] + shares->of[1], 1);
    EXPECT_LT(std::abs(shares->of[0] - last), 0.01);
    last = shares->of[0];
  }
  EXPECT_EQ(load_shares(kWalk, 0.4)->of[0], 1);
  EXPECT_NEAR(load_shares(kWalk, 0.6)->of[0], 0.5, 1e-12);
  EXPECT_EQ(load_shares(kWalk, 0.6)->leading, Side::kRight);
  EXPECT_EQ(load_shares(kWalk, 0.9)->of[1], 1);
}

TEST(LoadShares, AShortGapIsAnEventReadWrongALongOneIsFlight) {
  const std::vector<FootContact> late{{Side::kLeft, 0, 0.50}, {Side::kRight, 0.56, 1}};
  EXPECT_EQ(load_shares(late, 0.52)->leading, Side::kLeft);
  EXPECT_EQ(load_shares(late, 0.54)->leading, Side::kRight);
  const std::vector<FootContact> running{{Side::kLeft, 0, 0.3}, {Side::kRight, 0.5, 0.8}};
  EXPECT_FALSE(load_shares(running, 0.4));
  EXPECT_FALSE(load_shares({}, 0));
}

const std::array<FootPlace, 2> kFeet{FootPlace{{0.0, 0.1}, {0.12, 0.12}},
                                     FootPlace{{0.6, -0.1}, {0.72, -0.12}}};
const Vector3d kCom(0.35, 0.02, 0.95);

// The wrench of a force that acts at a point of the ground.
Wrench acting_at(const Vector2d& point, const Vector3d& force, double free_moment) {
  return {force, Vector3d(point.x(), point.y(), 0).cross(force) + Vector3d(0, 0, free_moment)};
}

TEST(SharedLoads, SumToTheWholeAboutAnyPoint) {
  for (const double left : {1.0, 0.7, 0.31, 0.0}) {
    const Vector2d centre = left * Vector2d(0.1, 0.11) + (1 - left) * Vector2d(0.62, -0.1);
    const Wrench whole = acting_at(centre, {40, -20, 700}, 3);
    const GroundLoads loads = shared_loads(whole, {{left, 1 - left}, Side::kRight}, kFeet, kCom);
    const Wrench sum = sum_of(loads.feet);
    EXPECT_TRUE(sum.force.isApprox(whole.force, 1e-12));
    EXPECT_TRUE(sum.moment.isApprox(whole.moment, 1e-9)) << left;
    EXPECT_NEAR(loads.unexplained, 0, 1e-9);
    EXPECT_NEAR(loads.feet[0].force.z(), left * 700, 1e-9);
  }
}

TEST(SharedLoads, OneFootTakesTheCentreOfPressureAsItIs) {
  const Wrench whole = acting_at({0.05, 0.09}, {10, 5, 650}, -2);
  const GroundLoads loads = shared_loads(whole, {{1, 0}, Side::kLeft}, kFeet, kCom);
  EXPECT_TRUE(loads.feet[0].centre.isApprox(Vector2d(0.05, 0.09), 1e-12));
  EXPECT_NEAR(loads.feet[0].free_moment, -2, 1e-9);
  EXPECT_FALSE(loads.feet[1].centre.allFinite());
  EXPECT_EQ(loads.feet[1].force, Vector3d::Zero());
}

TEST(SharedLoads, FeetBrakeAndPushAgainstEachOther) {
  const Wrench whole = acting_at({0.36, 0}, {0, 0, 700}, 0);
  const GroundLoads loads = shared_loads(whole, {{0.5, 0.5}, Side::kRight}, kFeet, kCom);
  EXPECT_GT(loads.feet[0].force.x(), 50);   // the rear foot pushes forward
  EXPECT_LT(loads.feet[1].force.x(), -50);  // the front foot brakes
}

TEST(SharedLoads, WhatNoSoleCanGiveIsUnexplained) {
  const Wrench whole = acting_at({0.8, 0.1}, {0, 0, 700}, 0);
  const GroundLoads loads = shared_loads(whole, {{1, 0}, Side::kLeft}, kFeet, kCom);
  EXPECT_LT(loads.feet[0].centre.x(), 0.2);
  EXPECT_NEAR(loads.unexplained, 700 * (Vector2d(0.8, 0.1) - loads.feet[0].centre).norm(), 1e-6);
}

TEST(SharedLoads, MirroredBodiesHaveMirroredLoads) {
  const auto flip = [](Vector2d p) { return Vector2d(p.x(), -p.y()); };
  const Wrench whole = acting_at({0.3, 0.02}, {30, 15, 720}, 4);
  const Wrench mirrored = acting_at({0.3, -0.02}, {30, -15, 720}, -4);
  const std::array<FootPlace, 2> feet{FootPlace{flip(kFeet[1].ankle), flip(kFeet[1].ball)},
                                      FootPlace{flip(kFeet[0].ankle), flip(kFeet[0].ball)}};
  const Vector3d com(kCom.x(), -kCom.y(), kCom.z());
  const GroundLoads a = shared_loads(whole, {{0.6, 0.4}, Side::kRight}, kFeet, kCom);
  const GroundLoads b = shared_loads(mirrored, {{0.4, 0.6}, Side::kLeft}, feet, com);
  for (size_t side = 0; side < 2; ++side) {
    EXPECT_TRUE(flip(a.feet[side].centre).isApprox(b.feet[1 - side].centre, 1e-12));
    EXPECT_NEAR(a.feet[side].force.y(), -b.feet[1 - side].force.y(), 1e-9);
    EXPECT_NEAR(a.feet[side].free_moment, -b.feet[1 - side].free_moment, 1e-9);
  }
}

TEST(SharedLoads, NothingPressesNothing) {
  const GroundLoads loads = shared_loads({}, {{1, 0}, Side::kLeft}, kFeet, kCom);
  EXPECT_EQ(sum_of(loads.feet).force, Vector3d::Zero());
}

}  // namespace
}  // namespace walktrack
