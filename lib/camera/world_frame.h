// The library's world has z up and the ground at z = 0; a calibration may have any axes. This is
// the rigid transform between the two, which is applied to all inputs and undone in all outputs.
#pragma once

#include <Eigen/Core>

#include "camera/camera.h"

namespace walktrack {
inline namespace camera {

struct WorldFrame {  // world_from_calibration: x_world = rotation x_calibration + translation
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  // m
};

// The frame in which the plane normal . x = offset (calibration axes, m) is z = 0 and the normal
// points up. It rotates by the smallest angle, so that axes in the ground plane do not change; the
// calibration's origin stays above (or below) the world's. The normal may have any length except
// zero (InputError).
WorldFrame world_frame_on_ground(const Eigen::Vector3d& normal, double offset);

Eigen::Vector3d world_from_calibration(const WorldFrame& frame, const Eigen::Vector3d& point);
Eigen::Vector3d calibration_from_world(const WorldFrame& frame, const Eigen::Vector3d& point);

// A camera in calibration axes converted to the world, and back.
Camera camera_in_world(const WorldFrame& frame, Camera camera);
Camera camera_in_calibration(const WorldFrame& frame, Camera camera);

}  // namespace camera
}  // namespace walktrack
