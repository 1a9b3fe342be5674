#include "camera/world_frame.h"

#include <Eigen/Geometry>

#include "core/errors.h"

namespace walktrack {
inline namespace camera {

WorldFrame world_frame_on_ground(const Eigen::Vector3d& normal, double offset) {
  const double length = normal.norm();
  if (!(length > 1e-9) || !normal.allFinite()) {
    throw InputError(describe({"", 0, "ground.normal"}, "no direction", "a vector of length > 0"));
  }
  const Eigen::Vector3d up = normal / length;
  WorldFrame frame;
  // The shortest turn from `up` to z. If the normal points straight down its axis can be any
  // horizontal one: x is chosen, so that y and z change sign.
  if (up.z() < -1 + 1e-12) {
    frame.rotation = Eigen::Vector3d(1, -1, -1).asDiagonal();
  } else {
    frame.rotation =
        Eigen::Quaterniond(1 + up.z(), up.y(), -up.x(), 0).normalized().toRotationMatrix();
  }
  frame.translation = {0, 0, -offset / length};
  return frame;
}

Eigen::Vector3d world_from_calibration(const WorldFrame& frame, const Eigen::Vector3d& point) {
  return frame.rotation * point + frame.translation;
}

Eigen::Vector3d calibration_from_world(const WorldFrame& frame, const Eigen::Vector3d& point) {
  return frame.rotation.transpose() * (point - frame.translation);
}

// camera_from_world = camera_from_calibration * calibration_from_world
Camera camera_in_world(const WorldFrame& frame, Camera camera) {
  camera.rotation = camera.rotation * frame.rotation.transpose();
  camera.translation -= camera.rotation * frame.translation;
  return camera;
}

Camera camera_in_calibration(const WorldFrame& frame, Camera camera) {
  camera.translation += camera.rotation * frame.translation;
  camera.rotation = camera.rotation * frame.rotation;
  return camera;
}

}  // namespace camera
}  // namespace walktrack
