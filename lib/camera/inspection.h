// What a calibration says about where a camera stands and what it sees, in words that a person can
// compare with the room.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "camera/camera.h"

namespace walktrack {
inline namespace camera {

struct CameraInspection {
  Eigen::Vector3d centre;      // world, m
  double tilt = 0;             // of the optical axis below the horizon, rad
  double roll = 0;             // turn of the image about the axis, rad; pi = upside down
  double horizontal_view = 0;  // angle between the middles of the left and right edge, rad
  double vertical_view = 0;    // of the upper and lower edge, rad
  std::vector<Eigen::Vector2d> footprint;  // ground seen along the image's border, m; may be empty
  // Where on the ground a person is seen whole, about in the middle of the image and half as high
  // as it; nullopt if nowhere within kFarthestGround.
  std::optional<Eigen::Vector2d> standing_place;
  double person_px = 0;  // height of the person there in the image
};

inline constexpr double kFarthestGround = 100;  // m from the camera

// `person_height` in metres.
CameraInspection inspect_camera(const Camera& camera, double person_height);

// Whether a person who stands there is seen from the feet to the top of the head.
bool sees_person(const Camera& camera, const Eigen::Vector2d& place, double person_height);

// Whether the lens model is one to one over the whole image.
bool lens_covers_image(const Camera& camera);

}  // namespace camera
}  // namespace walktrack
