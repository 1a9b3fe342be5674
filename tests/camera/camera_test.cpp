#include "camera/camera.h"

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "core/conventions.h"
#include "core/errors.h"
#include "core/rng.h"
#include "tests/camera/sample_cameras.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

class EveryLens : public testing::TestWithParam<SampleCamera> {
 protected:
  Camera camera_ = sample_camera(GetParam());
  Rng rng_{7, Purpose::kTest};
  // A point around the origin that is in the image or near it.
  Vector3d random_point() {
    return {4 * rng_.uniform() - 2, 4 * rng_.uniform() - 2, 2.2 * rng_.uniform()};
  }
  Vector2d random_pixel() { return {640 * rng_.uniform(), 480 * rng_.uniform()}; }
};

INSTANTIATE_TEST_SUITE_P(Camera, EveryLens, testing::ValuesIn(sample_lenses()),
                         [](const auto& test) { return test.param.name; });

cv::Matx33d to_cv(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

Vector2d project_by_opencv(const Camera& camera, const SampleCamera& lens, const Vector3d& point) {
  const cv::Matx33d matrix(camera.focal_px.x(), 0, camera.centre_px.x(), 0, camera.focal_px.y(),
                           camera.centre_px.y(), 0, 0, 1);
  cv::Vec3d rodrigues;
  cv::Rodrigues(to_cv(camera.rotation), rodrigues);
  const Vector3d& t = camera.translation;
  const std::vector<cv::Point3d> points{{point.x(), point.y(), point.z()}};
  std::vector<cv::Point2d> pixels;
  if (lens.fisheye) {
    cv::fisheye::projectPoints(points, pixels, rodrigues, cv::Vec3d(t.x(), t.y(), t.z()), matrix,
                               lens.coefficients);
  } else {
    cv::projectPoints(points, rodrigues, cv::Vec3d(t.x(), t.y(), t.z()), matrix, lens.coefficients,
                      pixels);
  }
  return {pixels[0].x, pixels[0].y};
}

TEST_P(EveryLens, ProjectsAsOpenCv) {
  for (int i = 0; i < 200; ++i) {
    const Vector3d point = random_point();
    const auto pixel = project(camera_, point);
    ASSERT_TRUE(pixel);
    // Rounding through Rodrigues and back: about 1e-13 relative of 1000 px.
    EXPECT_LT((*pixel - project_by_opencv(camera_, GetParam(), point)).norm(), 1e-8);
  }
}

TEST_P(EveryLens, JacobianIsTheCentralDifference) {
  constexpr double kStep = 1e-5;  // third derivatives give 1e-10 * 1e3 px, rounding 1e-12 / 1e-5
  for (int i = 0; i < 50; ++i) {
    const Vector3d point = 1.5 * random_point();
    const auto at = project_with_jacobian(camera_, point);
    ASSERT_TRUE(at);
    EXPECT_LT((at->pixel - *project(camera_, point)).norm(), 1e-10);
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d step = kStep * Vector3d::Unit(axis);
      const Vector2d slope =
          (*project(camera_, point + step) - *project(camera_, point - step)) / (2 * kStep);
      EXPECT_LT((at->d_pixel_d_point.col(axis) - slope).norm(), 1e-4);
    }
  }
}

TEST_P(EveryLens, RayOfAPixelProjectsOntoIt) {
  for (int i = 0; i < 200; ++i) {
    const Vector2d pixel = random_pixel();
    const auto ray = unproject(camera_, pixel);
    ASSERT_TRUE(ray);
    EXPECT_NEAR(ray->direction.norm(), 1, 1e-14);
    for (const double distance : {0.5, 7.0}) {
      const auto back = project(camera_, ray->origin + distance * ray->direction);
      ASSERT_TRUE(back);
      EXPECT_LT((*back - pixel).norm(), 1e-7);
    }
  }
}

TEST_P(EveryLens, GroundPointLiesOnTheGroundAndProjectsBack) {
  const auto point = ground_point(camera_, Vector2d(300, 400));
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->z(), 0, 1e-12);
  EXPECT_LT((*project(camera_, *point) - Vector2d(300, 400)).norm(), 1e-7);
}

// A point outside the view must never appear inside the image, and the image moves outwards with
// the point.
TEST_P(EveryLens, NeverFoldsOverOutsideTheImage) {
  for (int spoke = 0; spoke < 36; ++spoke) {
    const double angle = rad_from_deg(10.0 * spoke);
    const Vector2d direction(std::cos(angle), std::sin(angle));
    double last = 0;
    for (double radius = 0.02; radius < 200; radius *= 1.02) {
      const double bent = distort(camera_, radius * direction).dot(direction);
      EXPECT_GT(bent, last) << "radius " << radius << " spoke " << spoke;
      last = bent;
    }
  }
}

TEST_P(EveryLens, UndistortsFarOutsideTheImage) {
  for (const double radius : {1.0, 2.0, 5.0}) {
    const Vector2d point(0.6 * radius, -0.8 * radius);
    const auto back = undistort(camera_, distort(camera_, point));
    ASSERT_TRUE(back);
    EXPECT_LT((*back - point).norm(), 1e-8 * (1 + radius));
  }
}

TEST_P(EveryLens, CoefficientsSurviveTheRoundTrip) {
  const auto written = distortion_coefficients(camera_);
  Camera copy = camera_;
  set_distortion(copy, {written.begin(), written.end()}, GetParam().fisheye);
  EXPECT_EQ(copy.distortion, camera_.distortion);
  EXPECT_EQ(copy.lens, camera_.lens);
  EXPECT_EQ(copy.trusted_radius, camera_.trusted_radius);
}

Camera plain() { return sample_camera({"pinhole", {}}); }

TEST(Camera, ChoosesTheCheapestLens) {
  Camera camera = plain();
  set_distortion(camera, std::vector<double>{0, 0, 0, 0, 0});
  EXPECT_EQ(camera.lens, Lens::kPinhole);
  set_distortion(camera, std::vector<double>{0.1, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(camera.lens, Lens::kBrown);
  set_distortion(camera, std::vector<double>{0.1, 0, 0, 0, 0, 0.1, 0, 0});
  EXPECT_EQ(camera.lens, Lens::kRational);
}

TEST(Camera, RefusesOddCoefficients) {
  Camera camera = plain();
  EXPECT_THROW(set_distortion(camera, std::vector<double>{1, 2, 3}), InputError);
  EXPECT_THROW(set_distortion(camera, std::vector<double>(5), true), InputError);
  EXPECT_THROW(set_distortion(camera, std::vector<double>{NAN, 0, 0, 0}), InputError);
}

TEST(Camera, NothingBehindHasAPixel) {
  const Camera camera = plain();
  const Vector3d centre = camera_centre(camera);
  const Vector3d ahead = camera.rotation.row(2);
  EXPECT_TRUE(project(camera, centre + 0.02 * ahead));
  EXPECT_FALSE(project(camera, centre + 0.5 * kMinDepth * ahead));
  EXPECT_FALSE(project(camera, centre));
  EXPECT_FALSE(project(camera, centre - ahead));
  EXPECT_FALSE(project(camera, Vector3d::Constant(NAN)));
  EXPECT_FALSE(project_with_jacobian(camera, centre - ahead));
}

TEST(Camera, CentreProjectsAlongTheAxis) {
  const Camera camera = plain();
  EXPECT_LT((camera_centre(camera) - Vector3d(1.0, -6.0, 3.2)).norm(), 1e-12);
  EXPECT_LT((*project(camera, Vector3d(0.2, 0, 1)) - camera.centre_px).norm(), 1e-9);
}

TEST(Camera, NoGroundAboveTheHorizon) {
  Camera camera = plain();
  camera.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // level, looking along y
  camera.translation = -camera.rotation * Vector3d(0, 0, 1.5);
  EXPECT_FALSE(ground_point(camera, camera.centre_px - Vector2d(0, 1)));
  EXPECT_TRUE(ground_point(camera, camera.centre_px + Vector2d(0, 1)));
}

TEST(Camera, FisheyeHasNoRayBeyondItsHalfSpace) {
  const Camera camera = sample_camera({"fisheye", {0, 0, 0, 0}, true});
  // theta_d = theta without coefficients: 90 degrees are pi/2 focal lengths from the centre.
  EXPECT_TRUE(unproject(camera, camera.centre_px + Vector2d(520 * 1.55, 0)));
  EXPECT_FALSE(unproject(camera, camera.centre_px + Vector2d(520 * 1.7, 0)));
}

TEST(Camera, InsideImageCountsPixelSquares) {
  const Camera camera = plain();
  EXPECT_TRUE(inside_image(camera, {-0.5, -0.5}));
  EXPECT_TRUE(inside_image(camera, {639.4, 479.4}));
  EXPECT_FALSE(inside_image(camera, {639.5, 0}));
  EXPECT_FALSE(inside_image(camera, {0, -0.6}));
}

TEST(Camera, ScaledDownSeesTheSameRays) {
  const Camera camera = sample_camera(sample_lenses()[1]);
  const Camera small = scaled_down(camera, 4);
  EXPECT_EQ(small.width_px, 160);
  // The small pixel (i, j) covers the large pixels 4i .. 4i+3, centred at 4i + 1.5.
  const auto ray = unproject(small, Vector2d(10, 20));
  const auto same = unproject(camera, Vector2d(41.5, 81.5));
  EXPECT_LT((ray->direction - same->direction).norm(), 1e-11);
}

}  // namespace
}  // namespace walktrack
