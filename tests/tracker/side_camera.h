// A camera that looks along +y from 6 m in front of the origin.
#pragma once

#include "camera/camera.h"

namespace walktrack {

inline Camera side_camera(double height) {
  Camera camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.focal_px = {600, 600};
  camera.centre_px = {319.5, 239.5};
  camera.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  camera.translation = -camera.rotation * Eigen::Vector3d(0, -6, height);
  return camera;
}

}  // namespace walktrack
