// Describes a calibrated camera, its position and its view, in numbers that a person can compare
// with the room.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "camera/camera.h"

namespace walktrack {
inline namespace camera {

struct CameraInspection {
  Eigen::Vector3d centre;      // world, m
  double tilt = 0;             // of the optical axis below the horizon, rad
  double roll = 0;             // rotation of the image about the axis, rad; pi = upside down
  double horizontal_view = 0;  // angle between the middles of the left and right edges, rad
  double vertical_view = 0;    // of the upper and lower edges, rad
  std::vector<Eigen::Vector2d> footprint;  // ground along the image's border, m; may be empty
  // A place on the ground at which a person is completely visible, near the middle of the image and
  // half as high as it; nullopt if there is none within kFarthestGround.
  std::optional<Eigen::Vector2d> standing_place;
  double person_px = 0;  // height of the person there in the image
};

inline constexpr double kFarthestGround = 100;  // m from the camera

// `person_height` in metres.
CameraInspection inspect_camera(const Camera& camera, double person_height);

// Whether a person who stands there is visible from the feet to the top of the head.
bool sees_person(const Camera& camera, const Eigen::Vector2d& place, double person_height);

// The hips of a person who stands at a place on the ground, roughly; world, m.
Eigen::Vector3d hips_at(const Eigen::Vector2d& place, double person_height);

// Whether a point of the world is in the image of any camera.
bool in_any_picture(std::span<const Camera> cameras, const Eigen::Vector3d& point);

// Metres for each pixel of the image of a person who stands at a place on the ground, from the
// middle of the body; 0 if the camera does not see it.
double metres_per_px(const Camera& camera, const Eigen::Vector2d& place);

// Whether somewhere a person is visible to `camera` from the feet to the top of the head, at least
// half as high in the image as at its standing place, and at least the hips to `other`.
bool share_a_view(const Camera& camera, const Camera& other, double person_height);

// Whether the lens model is one to one over the whole image.
bool lens_covers_image(const Camera& camera);

}  // namespace camera
}  // namespace walktrack
