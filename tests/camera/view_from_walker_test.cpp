#include "camera/view_from_walker.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/conventions.h"
#include "core/errors.h"
#include "core/rng.h"

namespace walktrack {
namespace {

// At (0, 0, height), looking along y, `tilt` down and turned by `roll`.
Camera made_camera(double focal_px, double height, double tilt, double roll) {
  Camera camera;
  camera.width_px = 1280;
  camera.height_px = 720;
  camera.focal_px = {focal_px, focal_px};
  camera.centre_px = {639.5, 359.5};
  const Eigen::Vector3d ahead(0, std::cos(tilt), -std::sin(tilt));
  camera.rotation.row(0) = Eigen::Vector3d::UnitX();
  camera.rotation.row(1) = ahead.cross(Eigen::Vector3d::UnitX());
  camera.rotation.row(2) = ahead;
  camera.rotation =
      Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()).toRotationMatrix() * camera.rotation;
  camera.translation = -camera.rotation * Eigen::Vector3d(0, 0, height);
  return camera;
}

std::vector<SeenStature> seen_along(const Camera& camera, Eigen::Vector2d from, Eigen::Vector2d to,
                                    double stature) {
  std::vector<SeenStature> out;
  for (int i = 0; i <= 6; ++i) {
    const Eigen::Vector2d place = from + (to - from) * i / 6;
    const auto foot = project(camera, {place.x(), place.y(), 0}),
               head = project(camera, {place.x(), place.y(), stature});
    out.push_back({foot->x(), head->y(), foot->y()});
  }
  return out;
}

ViewAssumptions usual(double focal_px) {
  return {.width_px = 1280,
          .height_px = 720,
          .focal_px = focal_px,
          .focal_sd = 0,
          .stature = 1.7,
          .stature_sd = 0,
          .tilt = 0,
          .tilt_sd = rad_from_deg(2),
          .roll_sd = rad_from_deg(1)};
}

TEST(ViewFromWalker, OfALevelCameraIsExact) {
  const Camera truth = made_camera(1000, 1.3, 0, 0);
  const WalkerView view = view_from_walker(seen_along(truth, {-2, 6}, {2, 6}, 1.7), usual(1000));
  EXPECT_NEAR(view.height.value, 1.3, 1e-6);
  EXPECT_NEAR(view.distance.value, 6, 1e-5);
  EXPECT_NEAR(view.metres_per_px.value, 6.0 / 1000, 1e-8);
  EXPECT_LT(view.residual, 1e-6);
  // The origin is on the floor below the middle position.
  EXPECT_NEAR(camera_centre(view.camera).y(), -6, 1e-5);
  EXPECT_NEAR(camera_centre(view.camera).z(), 1.3, 1e-6);
  EXPECT_NEAR((camera_point(view.camera, {0, 0, 1}) - camera_point(truth, {0, 6, 1})).norm(), 0,
              1e-5);
}

TEST(ViewFromWalker, NearAndFarPlacesTellHeightAndTilt) {
  const Camera truth = made_camera(900, 1.1, rad_from_deg(4), rad_from_deg(-1.5));
  ViewAssumptions given = usual(900);
  given.row_sd = 1e-5;
  const WalkerView view = view_from_walker(seen_along(truth, {-3, 9}, {2, 4}, 1.7), given);
  EXPECT_NEAR(view.height.value, 1.1, 1e-3);
  EXPECT_NEAR(deg_from_rad(view.tilt.value), 4, 0.02);
  EXPECT_NEAR(deg_from_rad(view.roll.value), -1.5, 0.02);
  EXPECT_LT(view.height.sd, 1e-2);
}

// For a walk straight across, the tilt is an assumption, which contributes to the uncertainty of
// the height and not to that of the scale.
TEST(ViewFromWalker, OneDistanceLeavesTheTiltOpen) {
  const Camera truth = made_camera(1000, 1.3, 0, 0);
  const WalkerView view = view_from_walker(seen_along(truth, {-2, 6}, {2, 6}, 1.7), usual(1000));
  EXPECT_NEAR(deg_from_rad(view.tilt.sd), 2, 0.1);
  EXPECT_NEAR(view.height.sd, 6 * std::tan(rad_from_deg(2)), 0.03);
  EXPECT_LT(view.metres_per_px.sd / view.metres_per_px.value, 0.01);
}

// A wrong focal length changes the distance in proportion, and does not affect the scale.
TEST(ViewFromWalker, ScaleDoesNotNeedTheFocalLength) {
  const auto seen = seen_along(made_camera(1000, 1.3, 0, 0), {-2, 6}, {2, 6}, 1.7);
  ViewAssumptions given = usual(1200);
  given.focal_sd = 120;
  const WalkerView view = view_from_walker(seen, given);
  EXPECT_NEAR(view.metres_per_px.value, 6.0 / 1000, 6e-6);
  EXPECT_NEAR(view.distance.value, 7.2, 0.05);
  EXPECT_NEAR(view.distance.sd, 0.72, 0.1);
}

// The sides and diagonals of a tile in the camera's image.
std::vector<FloorLength> tile(const Camera& camera, Eigen::Vector2d at, double side) {
  const std::array<Eigen::Vector2d, 4> corners{at, at + Eigen::Vector2d(side, 0),
                                               at + Eigen::Vector2d(side, side),
                                               at + Eigen::Vector2d(0, side)};
  std::vector<FloorLength> out;
  for (size_t i = 0; i < 4; ++i)
    for (size_t k = i + 1; k < 4; ++k) {
      const auto pixel = [&](size_t n) {
        return *project(camera, {corners[n].x(), corners[n].y(), 0});
      };
      out.push_back({pixel(i), pixel(k), (corners[k] - corners[i]).norm()});
    }
  return out;
}

// A tile on the floor determines what a walk straight across does not: tilt, focal length,
// distance.
TEST(ViewFromWalker, ATileTellsTiltAndLens) {
  const Camera truth = made_camera(1000, 1.3, rad_from_deg(3), rad_from_deg(0.5));
  ViewAssumptions given = usual(1150);
  given.focal_sd = 140;
  given.row_sd = 1e-3;
  const auto seen = seen_along(truth, {-2, 6}, {2, 6}, 1.7);
  const WalkerView without = view_from_walker(seen, given);
  EXPECT_GT(without.distance.sd, 0.5);
  given.floor = tile(truth, {-0.5, 4}, 1);
  given.point_sd_px = 0.1;
  const WalkerView with = view_from_walker(seen, given);
  EXPECT_NEAR(with.focal_px.value, 1000, 2);
  EXPECT_NEAR(deg_from_rad(with.tilt.value), 3, 0.05);
  EXPECT_NEAR(with.height.value, 1.3, 0.005);
  EXPECT_NEAR(with.distance.value, 6, 0.02);
  EXPECT_LT(with.distance.sd, 0.1);
  EXPECT_LT(with.floor_rms, 1e-3);
}

TEST(ViewFromWalker, TwoPointsOnTheFloorTellTheScaleWhereTheStatureIsWrong) {
  const Camera truth = made_camera(1000, 1.3, 0, 0);
  ViewAssumptions given = usual(1000);
  given.tilt_sd = rad_from_deg(0.1);
  const auto seen = seen_along(truth, {-2, 6}, {2, 6}, 1.7);
  given.row_sd = 0.05;  // the stature is uncertain
  given.floor = {{*project(truth, {-1, 5, 0}), *project(truth, {1, 5, 0}), 2}};
  given.stature = 1.7 * 1.04;
  const WalkerView view = view_from_walker(seen, given);
  EXPECT_NEAR(view.metres_per_px.value / (6.0 / 1000), 1, 0.01);
}

TEST(ViewFromWalker, SaysWhenAPointOfTheFloorIsInTheSky) {
  const Camera truth = made_camera(1000, 1.3, 0, 0);
  ViewAssumptions given = usual(1000);
  given.floor = {{{600, 10}, {700, 500}, 1}};
  EXPECT_THROW(view_from_walker(seen_along(truth, {-2, 6}, {2, 6}, 1.7), given), InputError);
}

// If the truth is drawn from the assumptions, it is within two standard deviations as often as
// stated.
TEST(ViewFromWalker, BandsHold) {
  constexpr int kTrials = 300;
  int height = 0, scale = 0, distance = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Rng rng(5, Purpose::kTest, static_cast<uint32_t>(trial));
    ViewAssumptions given = usual(1000);
    given.focal_sd = 100;
    given.stature_sd = 0.03;
    const double focal = 1000 + given.focal_sd * rng.normal(), h = 0.8 + 0.8 * rng.uniform();
    const Camera truth =
        made_camera(focal, h, given.tilt_sd * rng.normal(), given.roll_sd * rng.normal());
    const double stature = given.stature + given.stature_sd * rng.normal(),
                 far = 5 + 4 * rng.uniform();
    auto seen = seen_along(truth, {-2, 5}, {2, far}, stature);
    for (SeenStature& each : seen)
      each.top_px += given.row_sd * (each.bottom_px - each.top_px) * rng.normal();
    const WalkerView view = view_from_walker(seen, given);
    const Eigen::Vector3d middle(0, (5 + far) / 2, 0);
    const auto holds = [](const Measured& found, double value) {
      return std::abs(found.value - value) < 2 * found.sd;
    };
    height += holds(view.height, h);
    scale += holds(view.metres_per_px, camera_point(truth, middle).z() / focal);
    distance += holds(view.distance, middle.y());
  }
  // 95.4 % of 300, less three standard errors.
  for (const int held : {height, scale, distance}) EXPECT_GE(held, 0.915 * kTrials);
  for (const int held : {height, scale, distance}) EXPECT_LE(held, 0.995 * kTrials);
}

TEST(ViewFromWalker, SaysWhenFeetAreAboveTheHorizon) {
  const std::vector<SeenStature> seen{{600, 10, 100}};
  EXPECT_THROW(view_from_walker(seen, usual(1000)), InputError);
  ViewAssumptions steep = usual(1000);
  steep.tilt = rad_from_deg(20);
  EXPECT_GT(view_from_walker(seen, steep).height.value, 0);
}

}  // namespace
}  // namespace walktrack
