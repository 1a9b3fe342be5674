// Cameras from their numbers, for tests.
#pragma once

#include <span>

#include <Eigen/Geometry>

#include "camera/camera.h"

namespace walktrack {

// At the origin, looking along z.
inline Camera lens(const Eigen::Vector2i& size_px, const Eigen::Vector2d& focal_px,
                   const Eigen::Vector2d& centre_px, std::span<const double> coefficients = {},
                   bool fisheye = false) {
  Camera camera;
  camera.width_px = size_px.x();
  camera.height_px = size_px.y();
  camera.focal_px = focal_px;
  camera.centre_px = centre_px;
  set_distortion(camera, coefficients, fisheye);
  return camera;
}

// The camera at `eye`, `target` on its axis, upright.
inline Camera looking_at(Camera camera, const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d ahead = (target - eye).normalized();
  const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
  camera.rotation << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
  camera.translation = -camera.rotation * eye;
  return camera;
}

}  // namespace walktrack
