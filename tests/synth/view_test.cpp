#include "synth/recording/view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "synth/recording/sensor.h"
#include "synth/world/settings.h"
#include "tests/camera/made_camera.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A camera 4 m away on the y axis, 1 m up, looking along +y and slightly down and aside.
Camera test_camera(bool distorted) {
  const std::array bent{-0.15, 0.05, 1e-3, -5e-4};
  const Vector3d eye(0.3, -4, 1);
  return looking_at(lens({640, 480}, {620, 615}, {322.3, 236.8},
                         distorted ? std::span<const double>(bent) : std::span<const double>()),
                    eye, eye + Vector3d(-0.1, 1, -0.05));
}

World empty_world() { return make_world(Setting::kStudio, {0, 0}, 5, {}, 1); }

// Neither along rows nor along columns of pixels, for which all edges would be rounded alike.
const Vector3d kAxis = Vector3d(0.3, 0.1, 0.9).normalized();
const Vector3d kAcross = kAxis.cross(Vector3d::UnitX()).normalized();

PosedPart round_cone(const Vector3d& lower, double length, double below, double above) {
  return {lower,          lower + length * kAxis, kAcross,           kAcross.cross(kAxis),
          {below, below}, {above, above},         Appearance::kTrunk};
}

PosedPart ball_at(const Vector3d& centre, double radius) {
  return round_cone(centre - 5e-6 * kAxis, 1e-5, radius, radius);
}

struct Blob {
  double area = 0;
  Vector2d centroid = Vector2d::Zero();
  double equivalent_radius() const { return std::sqrt(area / kPi); }
};

Blob silhouette(const PosedPart& part) {
  static const World world = empty_world();
  static const View view = make_view(world, test_camera(false), 2);
  const Clothes dressed = clothes(0);
  const std::vector<DressedParts> walkers{dress(std::span(&part, 1), dressed)};
  const Plane<uint8_t> labels = labels_of(render(view, world, walkers).sights);
  Blob blob;
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      if (labels.at(x, y) == 0) continue;
      blob.area += 1;
      blob.centroid += Vector2d(x, y);
    }
  }
  blob.centroid /= blob.area;
  return blob;
}

// The image of a sphere is the ellipse of the directions v with (v . c)^2 = (c^2 - r^2) v^2.
Blob sphere_image(const Vector3d& centre, double radius) {
  const Camera camera = test_camera(false);
  const Vector3d c = camera_point(camera, centre);
  const Eigen::Matrix3d q =
      c * c.transpose() - (c.squaredNorm() - radius * radius) * Eigen::Matrix3d::Identity();
  const Eigen::Matrix2d a = q.topLeftCorner<2, 2>();
  const Vector2d b = q.topRightCorner<2, 1>();
  const Vector2d middle = -a.inverse() * b;
  const double k = q(2, 2) - b.dot(a.inverse() * b);
  return {kPi * std::abs(k) / std::sqrt(a.determinant()) * camera.focal_px.prod(),
          camera.focal_px.cwiseProduct(middle) + camera.centre_px};
}

// Area and centroid of the convex hull of points.
Blob hull_of(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  const auto cross = [](const Vector2d& o, const Vector2d& a, const Vector2d& b) {
    return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
  };
  std::vector<Vector2d> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const size_t start = hull.size();
    for (const Vector2d& p : points) {
      while (hull.size() >= start + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  Blob blob;
  for (size_t i = 0; i < hull.size(); ++i) {
    const Vector2d &p = hull[i], &n = hull[(i + 1) % hull.size()];
    const double twice = p.x() * n.y() - n.x() * p.y();
    blob.area += twice / 2;
    blob.centroid += twice / 6 * (p + n);
  }
  blob.centroid /= blob.area;
  return blob;
}

// Exact projections of the points of a round cone with half balls at its ends. The solid is convex
// except for a groove with a radius of (sqrt(1 + taper^2) - 1) at its thin end.
Blob cone_image(const Vector3d& lower, double length, double below, double above) {
  const Camera camera = test_camera(false);
  std::vector<Vector2d> points;
  for (int i = 0; i < 720; ++i) {
    const double around = i * kPi / 360;
    for (int k = 0; k <= 90; ++k) {
      const double down = k * kPi / 180;
      const Vector3d out =
          std::cos(down) * (std::cos(around) * kAcross + std::sin(around) * kAcross.cross(kAxis));
      const Vector3d up = std::sin(down) * kAxis;
      points.push_back(*project(camera, lower + below * (out - up)));
      points.push_back(*project(camera, lower + length * kAxis + above * (out + up)));
    }
  }
  return hull_of(points);
}

void expect_same(const Blob& found, const Blob& expected) {
  EXPECT_NEAR(found.equivalent_radius(), expected.equivalent_radius(), 0.1);
  EXPECT_NEAR(found.centroid.x(), expected.centroid.x(), 0.1);
  EXPECT_NEAR(found.centroid.y(), expected.centroid.y(), 0.1);
}

TEST(Silhouette, OfASphereIsItsAnalyticImage) {
  for (const double x : {-1.0, 0.0, 0.9}) {
    for (const double radius : {0.1, 0.4}) {
      const Vector3d centre(x, 0.2, 1.1);
      expect_same(silhouette(ball_at(centre, radius)), sphere_image(centre, radius));
    }
  }
}

TEST(Silhouette, OfACylinderAndOfATaperedConeAreHullsOfTheirProjections) {
  const Vector3d lower(-0.4, 0.1, 0.3);
  expect_same(silhouette(round_cone(lower, 0.9, 0.12, 0.12)), cone_image(lower, 0.9, 0.12, 0.12));
  expect_same(silhouette(round_cone(lower, 0.9, 0.20, 0.12)), cone_image(lower, 0.9, 0.20, 0.12));
}

TEST(Depth, IsExactOnSphereAndGround) {
  const World world = empty_world();
  const View view = make_view(world, test_camera(true), 2);
  const Vector3d centre(0.2, 0.1, 1.2);
  const double radius = 0.3;
  const PosedPart ball = ball_at(centre, radius);
  const Clothes dressed = clothes(0);
  const std::vector<DressedParts> walkers{dress(std::span(&ball, 1), dressed)};
  const Picture picture = render(view, world, walkers);
  const Plane<float> depth = depth_of(view, picture.sights);
  int on_ball = 0, on_ground = 0;
  for (int y = 0; y < depth.height; y += 3) {
    for (int x = 0; x < depth.width; x += 3) {
      const auto ray = unproject(view.camera, Vector2d(x, y));
      const Vector3d to = centre - ray->origin;
      const double along = to.dot(ray->direction);
      const double inside = radius * radius - to.squaredNorm() + along * along;
      // For grazing rays the 1e-7 of single precision becomes its root, so that the rim is left
      // out.
      if (std::abs(inside) < 0.01) continue;
      double distance = along - std::sqrt(std::max(0.0, inside));
      if (inside < 0) {
        if (ray->direction.z() > -0.01) continue;
        distance = -ray->origin.z() / ray->direction.z();
      }
      ++(inside > 0 ? on_ball : on_ground);
      const double expected =
          camera_point(view.camera, ray->origin + distance * ray->direction).z();
      // The ball is 1e-5 m longer than round, a ground point has the 6e-8 of single precision over
      // the sine 0.01 of the flattest ray.
      EXPECT_NEAR(depth.at(x, y), expected, (inside > 0 ? 2e-5 : 1e-5 * distance));
    }
  }
  EXPECT_GT(on_ball, 200);
  EXPECT_GT(on_ground, 2000);
}

TEST(Flow, FollowsTheSurfaceOfAMovingBody) {
  const World world = empty_world();
  const View view = make_view(world, test_camera(true), 2);
  const Body body = make_body(Subject{}, {.head = true, .arms = true});
  Pose pose;
  pose.root = {0, 0, 0.9};
  pose.legs[0].knee_flexion = 0.5;
  // The whole figure rotates about the vertical through (0.1, 0) and moves: every point is known.
  const double turn = 0.04;
  const Vector3d shift(0.03, -0.02, 0.005), pivot(0.1, 0, 0);
  const Eigen::AngleAxisd rotation(turn, Vector3d::UnitZ());
  Pose moved = pose;
  moved.heading += turn;
  moved.root = rotation * (pose.root - pivot) + pivot + shift;
  const Clothes dressed = clothes(1);
  const std::vector<DressedParts> now{
      dress(pose_parts(body, forward_kinematics(body, pose)), dressed)};
  const std::vector<DressedParts> next{
      dress(pose_parts(body, forward_kinematics(body, moved)), dressed)};
  const Picture picture = render(view, world, now);
  const Plane<float> depth = depth_of(view, picture.sights);
  const auto flow = flow_of(view, picture.sights, now, next);
  int checked = 0;
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      if (picture.sights.at(x, y).walker < 0) {
        ASSERT_TRUE(flow.at(x, y).isZero());
        continue;
      }
      const auto ray = unproject(view.camera, Vector2d(x, y));
      const double ahead = view.camera.rotation.row(2).dot(ray->direction);
      const Vector3d point = ray->origin + double(depth.at(x, y)) / ahead * ray->direction;
      const auto pixel = project(view.camera, rotation * (point - pivot) + pivot + shift);
      ASSERT_LT((*pixel - Vector2d(x, y) - flow.at(x, y).cast<double>()).norm(), 0.02);
      ++checked;
    }
  }
  EXPECT_GT(checked, 5000);
}

TEST(Render, IsTheSameForAnyThreadCountAndShowsTheWalkerAndItsShadow) {
  const World world = empty_world();
  const View one = make_view(world, test_camera(true), 1),
             two = make_view(world, test_camera(true), 2);
  EXPECT_TRUE(one.empty.values == two.empty.values);
  const Body body = make_body(Subject{}, {.head = true, .arms = false});
  Pose pose;
  pose.root = {0, 0, 0.9};
  const PosedParts parts = pose_parts(body, forward_kinematics(body, pose));
  const Clothes dressed = clothes(0);
  const std::vector<DressedParts> walkers{dress(parts, dressed)};
  const Picture picture = render(one, world, walkers);
  int changed = 0, darker = 0;
  for (size_t i = 0; i < picture.colour.values.size(); ++i) {
    if (picture.sights.values[i].walker >= 0) continue;
    if (picture.colour.values[i] == one.empty.values[i]) continue;
    ++changed;
    darker += picture.colour.values[i].sum() < one.empty.values[i].sum();
  }
  EXPECT_GT(changed, 500);
  EXPECT_GT(darker, changed / 2);
  World flat = world;
  flat.light.shadows = false;
  const Picture without = render(one, flat, walkers);
  EXPECT_TRUE(labels_of(without.sights).values == labels_of(picture.sights).values);
}

TEST(Sensor, NoiseHasItsSizeAndIsKeyedByFrameAndStream) {
  const Plane<Colour> grey(320, 240, Colour(0.5f, 0.5f, 0.5f));
  const Sensor sensor{.exposure = 1, .noise = 0.04, .flicker = 0};
  const auto bytes = developed(grey, sensor, 1, 0, 3);
  double sum = 0, squares = 0;
  for (const uint8_t byte : bytes) {
    sum += byte - 127.5;
    squares += (byte - 127.5) * (byte - 127.5);
  }
  const double n = double(bytes.size()), sd = 0.04 * 255;
  EXPECT_NEAR(sum / n, 0, 5 * sd / std::sqrt(n));
  // Rounding adds 1/12; the quantiles lose up to 1 % of the variance; 5 sd of a variance.
  EXPECT_NEAR(squares / n / (sd * sd + 1.0 / 12), 1, 0.01 + 5 * std::sqrt(2 / n));
  EXPECT_EQ(bytes, developed(grey, sensor, 1, 0, 3));
  EXPECT_NE(bytes, developed(grey, sensor, 1, 0, 4));
  EXPECT_NE(bytes, developed(grey, sensor, 1, 1, 3));
  EXPECT_NE(bytes, developed(grey, sensor, 2, 0, 3));
}

TEST(Sensor, MonochromePicturesHaveOneValueAPixel) {
  const Plane<Colour> light(32, 24, Colour(0.8f, 0.5f, 0.2f));
  const auto still =
      developed(light, {.exposure = 1, .noise = 0, .flicker = 0, .monochrome = true}, 1, 0, 0);
  EXPECT_EQ(still[0], 142);  // (0.299 * 0.8 + 0.587 * 0.5 + 0.114 * 0.2) * 255 = 141.7
  const auto noisy =
      developed(light, {.exposure = 1, .noise = 0.05, .flicker = 0, .monochrome = true}, 1, 0, 0);
  EXPECT_NE(noisy, still);
  for (size_t i = 0; i < noisy.size(); i += 3) {
    EXPECT_EQ(noisy[i], noisy[i + 1]);
    EXPECT_EQ(noisy[i], noisy[i + 2]);
  }
}

TEST(Sensor, ExposureAndFlickerScaleTheLight) {
  const Plane<Colour> grey(4, 4, Colour(0.4f, 0.5f, 0.6f));
  const auto dark = developed(grey, {.exposure = 0.5, .noise = 0, .flicker = 0}, 1, 0, 0);
  EXPECT_EQ(dark[0], 77);  // blue first: 0.6 * 0.5 * 255 = 76.5
  EXPECT_EQ(dark[2], 51);
  bool varies = false;
  for (uint32_t frame = 0; frame < 5; ++frame)
    varies = varies ||
             developed(grey, {1, 0, 0.1}, 1, 0, frame) != developed(grey, {1, 0, 0.1}, 1, 0, 7);
  EXPECT_TRUE(varies);
}

}  // namespace
}  // namespace walktrack
