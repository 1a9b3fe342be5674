// Laws of projection, for cameras of every kind.
#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <Eigen/Geometry>

#include "camera/camera.h"
#include "camera/world_frame.h"

namespace walktrack {
namespace {

double between(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 10'001) / 1e4;
}

Eigen::Vector3d some_point(double reach) {
  return {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
}

Eigen::Matrix3d some_rotation() {
  const Eigen::Vector3d axis = some_point(1) + Eigen::Vector3d(0, 0, 2.5);  // not zero
  return Eigen::AngleAxisd(between(-3, 3), axis.normalized()).toRotationMatrix();
}

// A camera with any pose, lens and image size, within the usual limits of distortion.
Camera some_camera() {
  Camera camera;
  camera.width_px = *rc::gen::inRange(16, 4000);
  camera.height_px = *rc::gen::inRange(16, 4000);
  const double focal = between(0.5, 4) * camera.width_px;
  camera.focal_px = {focal, focal * between(0.9, 1.1)};
  camera.centre_px = {between(0.4, 0.6) * camera.width_px, between(0.4, 0.6) * camera.height_px};
  camera.rotation = some_rotation();
  camera.translation = some_point(10);
  std::vector<double> bend{between(-0.3, 0.3), between(-0.1, 0.1), between(-0.01, 0.01),
                           between(-0.01, 0.01)};
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      bend.clear();
      break;
    case 1:
      return set_distortion(camera, std::vector<double>{bend[0] / 10, 0, 0, 0}, true), camera;
    case 2:
      bend.push_back(between(-0.02, 0.02));
      bend.insert(bend.end(), {between(-0.05, 0.05), 0, 0});
      break;
    default:
      break;
  }
  set_distortion(camera, bend);
  return camera;
}

// A point that is visible in the image, if the lens has a ray there.
struct Seen {
  Camera camera = some_camera();
  Eigen::Vector2d pixel{between(0, camera.width_px - 1), between(0, camera.height_px - 1)};
  std::optional<Ray> ray = unproject(camera, pixel);
  double distance = between(0.5, 50);  // m
  Eigen::Vector3d point() const { return ray->origin + distance * ray->direction; }
};

RC_GTEST_PROP(CameraLaw, WhatLiesOnAPixelsRayIsSeenThere, ()) {
  const Seen seen;
  RC_PRE(seen.ray.has_value());
  RC_ASSERT(std::abs(seen.ray->direction.norm() - 1) < 1e-12);
  const auto pixel = project(seen.camera, seen.point());
  RC_ASSERT(pixel.has_value());
  // The lens is inverted to 1e-9 of a focal length, which is 2e4 px at most.
  RC_ASSERT((*pixel - seen.pixel).norm() < 2e-5);
}

RC_GTEST_PROP(CameraLaw, TheJacobianIsHowThePixelMoves, ()) {
  const Seen seen;
  RC_PRE(seen.ray.has_value());
  const auto there = project_with_jacobian(seen.camera, seen.point());
  RC_ASSERT(there.has_value());
  const Eigen::Vector3d step = 1e-6 * some_rotation().col(0);
  const auto ahead = project(seen.camera, seen.point() + step);
  const auto behind = project(seen.camera, seen.point() - step);
  const Eigen::Vector2d moved = (*ahead - *behind) / 2;
  const Eigen::Vector2d told = there->d_pixel_d_point * step;
  // Central differences over 2 um: rounding of pixels of up to 1e4, and of coordinates of 50 m
  // that are multiplied by focal lengths of 2e4 px.
  RC_ASSERT((moved - told).norm() < 1e-5 * told.norm() + 1e-9);
}

// The whole world and its cameras moved together look the same.
RC_GTEST_PROP(CameraLaw, AMovedWorldLooksTheSame, ()) {
  const Seen seen;
  RC_PRE(seen.ray.has_value());
  const WorldFrame frame{some_rotation(), some_point(5)};
  const auto here = project(seen.camera, seen.point());
  const auto there =
      project(camera_in_world(frame, seen.camera), world_from_calibration(frame, seen.point()));
  RC_ASSERT(here.has_value() && there.has_value());
  RC_ASSERT((*here - *there).norm() < 1e-8);  // px: rounding of 50 m at 2e4 px per unit
}

}  // namespace
}  // namespace walktrack
