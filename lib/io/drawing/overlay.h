// Draws objects of the world into video frames of a calibrated camera. Lines follow the lens
// distortion. Left limbs are blue, right ones vermilion, the trunk white (colours that colour-blind
// people can distinguish; Okabe & Ito 2008).
//
// Images are 8-bit BGR of the camera's size. Nothing outside the image is drawn.
#pragma once

#include <optional>
#include <span>
#include <string>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "body/pose.h"
#include "camera/camera.h"

namespace walktrack {
inline namespace io {

// A straight line in the world.
void draw_line(cv::Mat& image, const Camera& camera, const Eigen::Vector3d& from,
               const Eigen::Vector3d& to, const cv::Scalar& bgr, int thickness_px = 1);

// Lines every metre on the ground in the square of `half_side` metres about `centre`.
void draw_ground_grid(cv::Mat& image, const Camera& camera, const Eigen::Vector2d& centre,
                      double half_side);

// Draws the world's axes at a point: x red, y green, z blue, each `length` metres long, with their
// names.
void draw_axes(cv::Mat& image, const Camera& camera, const Eigen::Vector3d& origin, double length);

// Draws bones between known joints, with arms if they are known. `arms` states whether the body has
// any.
void draw_skeleton(cv::Mat& image, const Camera& camera, const JointPositions& joints, bool arms,
                   int thickness_px);

// Draws many skeletons, blended over the image with this opacity, which shows the spread of a
// particle set.
void draw_spread(cv::Mat& image, const Camera& camera, std::span<const JointPositions> skeletons,
                 bool arms, double opacity);

// Draws a thin cross at a point of the image, `arm_px` long to all sides, for a detected keypoint.
void draw_cross(cv::Mat& image, const Eigen::Vector2d& px, const cv::Scalar& bgr, double arm_px);

// Draws a ring around a point of the image, or a straight line between two of them. The default
// thickness suits the size of the image.
void draw_ring(cv::Mat& image, const Eigen::Vector2d& px, int radius_px, const cv::Scalar& bgr);
void draw_stroke(cv::Mat& image, const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px,
                 const cv::Scalar& bgr, int thickness_px = 0);

// The colours of left and right limbs and of the trunk.
cv::Scalar left_colour();
cv::Scalar right_colour();
cv::Scalar trunk_colour();

// Draws a line of text in the upper left corner that is readable on any background.
void draw_caption(cv::Mat& image, const std::string& text);

// Thickness that suits the size of the image: 1 px for 480 rows, 2 for 960, …
int line_thickness(const cv::Mat& image);

}  // namespace io
}  // namespace walktrack
