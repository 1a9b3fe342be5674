#include "observation/calibration/camera_fit.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/rng.h"
#include "tests/camera/made_camera.h"
#include "tests/observation/board_video.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr Board kBoard{BoardKind::kChessboard, 8, 5, 0.04};

Camera usual_lens(std::span<const double> coefficients, bool fisheye = false) {
  return lens({640, 480}, {510, 515}, {325, 236}, coefficients, fisheye);
}

PixelPoints seen(Camera camera, const BoardPose& pose) {
  camera.rotation = pose.rotation;
  camera.translation = pose.translation;
  PixelPoints out;
  for (const Vector3d& point : board_points(kBoard)) out.push_back(project(camera, point).value());
  return out;
}

std::vector<PixelPoints> views_of(const Camera& camera) {
  std::vector<PixelPoints> out;
  for (const BoardPose& pose : board_poses(camera, kBoard)) out.push_back(seen(camera, pose));
  return out;
}

struct Case {
  const char* name;
  LensModel model;
  std::vector<double> coefficients;
};

const Case kCases[] = {
    {"pinhole", LensModel::kPinhole, {}},
    {"brown", LensModel::kBrown, {-0.2, 0.05, 0.001, -0.002}},
    {"rational", LensModel::kRational, {0.1, -0.05, 0.0005, 0.001, 0.01, 0.3, -0.02, 0.01}},
    {"fisheye", LensModel::kFisheye, {-0.02, 0.005, -0.002, 0.0005}},
};

// With exact views the error is the single precision of OpenCV's points (3e-5 px).
TEST(FitLens, ExactViewsGiveTheLensBackForEachModel) {
  for (const Case& each : kCases) {
    const Camera camera = usual_lens(each.coefficients, each.model == LensModel::kFisheye);
    const auto fit = fit_lens(kBoard, views_of(camera), 640, 480, each.model);
    ASSERT_TRUE(fit) << each.name;
    EXPECT_LT(fit->rms_px, 1e-2) << each.name;
    // Rational coefficients compensate each other, so that their effect on the image is compared.
    for (const Vector2d& flat : {Vector2d(0, 0), Vector2d(0.4, 0.2), Vector2d(-0.3, 0.3)}) {
      const Vector3d point = flat.homogeneous();
      const Vector2d miss = project_camera_point(fit->camera, point).value() -
                            project_camera_point(camera, point).value();
      EXPECT_LT(miss.norm(), 0.05) << each.name;
    }
    EXPECT_LT((fit->camera.focal_px - camera.focal_px).norm(), 0.5) << each.name;
  }
}

TEST(FitLens, NoiseComesBackAsMissesAndAsTheFocalLengthsDeviation) {
  const Camera camera = usual_lens(kCases[1].coefficients);
  constexpr double kNoise = 0.2;  // px
  Rng rng(1, Purpose::kTest);
  std::vector<PixelPoints> views = views_of(camera);
  for (PixelPoints& view : views)
    for (Vector2d& point : view) point += kNoise * Vector2d(rng.normal(), rng.normal());
  const auto fit = fit_lens(kBoard, views, 640, 480, LensModel::kBrown);
  ASSERT_TRUE(fit);
  // Length of a two-dimensional residual; 960 numbers, 8 + 72 of them fitted.
  EXPECT_NEAR(fit->rms_px, kNoise * std::sqrt(2.0 * (960 - 80) / 960), 0.02);
  const Vector2d error = (fit->camera.focal_px - camera.focal_px).cwiseAbs();
  EXPECT_TRUE((error.array() < 5 * fit->focal_sd_px.array()).all());
  EXPECT_LT(fit->focal_sd_px.maxCoeff(), 5);
}

TEST(FitLens, FacingViewsShowInTheAngleBetweenBoardsOrTheDeviation) {
  const Camera camera = usual_lens({});
  Rng rng(1, Purpose::kTest);
  std::vector<PixelPoints> views;
  for (const double u : {250.0, 320.0, 390.0, 300.0, 350.0}) {
    views.push_back(seen(camera, board_pose(camera, kBoard, {u, 240}, 1, 0, 0, 0)));
    for (Vector2d& point : views.back()) point += 0.1 * Vector2d(rng.normal(), rng.normal());
  }
  const auto fit = fit_lens(kBoard, views, 640, 480, LensModel::kPinhole);
  EXPECT_TRUE(!fit || fit->boards_apart < 0.2 || fit->focal_sd_px.maxCoeff() > 0.02 * 510);
  const auto tilted = fit_lens(kBoard, views_of(camera), 640, 480, LensModel::kPinhole);
  EXPECT_NEAR(tilted.value().boards_apart, 1.2, 0.1);  // 0.6 to either side
}

Camera placed(Camera camera) {
  camera.rotation << 1, 0, 0, 0, -0.3, -std::sqrt(1 - 0.09), 0, std::sqrt(1 - 0.09), -0.3;
  camera.translation = -camera.rotation * Vector3d(0.3, -4, 1.5);
  return camera;
}

TEST(FitPlace, ExactPointsGiveThePlaceBackForEachLens) {
  const std::vector<Vector3d> flat{{-1, 0, 0}, {1, 0, 0}, {1, 2, 0}, {-1, 2, 0}, {0, 1, 0}};
  std::vector<Vector3d> solid = flat;
  solid.push_back({0.5, 0.5, 1.6});
  for (const Case& each : kCases) {
    const Camera camera = placed(usual_lens(each.coefficients, each.model == LensModel::kFisheye));
    for (const auto& world : {flat, solid}) {
      PixelPoints pixels;
      for (const Vector3d& point : world) pixels.push_back(project(camera, point).value());
      const auto fit = fit_place(camera, pixels, world);
      ASSERT_TRUE(fit) << each.name;
      EXPECT_LT(fit->rms_px, 1e-3) << each.name;
      EXPECT_LT((camera_centre(fit->camera) - camera_centre(camera)).norm(), 1e-4) << each.name;
    }
  }
}

TEST(FitPlace, PointsThatDetermineNothingGiveNoPlaceOrABadOne) {
  const Camera camera = placed(usual_lens({}));
  const std::vector<Vector3d> world(4, Vector3d(0, 1, 0));
  const auto fit = fit_place(camera, {{1, 1}, {600, 1}, {1, 400}, {600, 400}}, world);
  EXPECT_TRUE(!fit || fit->rms_px > 10);
}

}  // namespace
}  // namespace walktrack
