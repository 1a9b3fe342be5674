// Drawing into video frames: what the world holds, seen through a calibrated camera. Lines follow
// the lens's distortion. Left limbs are blue, right ones vermilion, the trunk white (colours that
// colour-blind people tell apart; Okabe & Ito 2008).
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

// World axes at a point: x red, y green, z blue, `length` metres each, with their names.
void draw_axes(cv::Mat& image, const Camera& camera, const Eigen::Vector3d& origin, double length);

// Bones between known joints; arms where they are known. `arms` says whether the body has any.
void draw_skeleton(cv::Mat& image, const Camera& camera, const JointPositions& joints, bool arms,
                   int thickness_px);

// Many skeletons at once, blended over the image with this opacity: the spread of a particle set.
void draw_spread(cv::Mat& image, const Camera& camera, std::span<const JointPositions> skeletons,
                 bool arms, double opacity);

// A thin cross at a point of the image, `arm_px` long to all sides: what a detector saw there.
void draw_cross(cv::Mat& image, const Eigen::Vector2d& px, const cv::Scalar& bgr, double arm_px);

// A ring about a point of the image, and a straight line between two of them; as thick as suits the
// image unless told otherwise.
void draw_ring(cv::Mat& image, const Eigen::Vector2d& px, int radius_px, const cv::Scalar& bgr);
void draw_stroke(cv::Mat& image, const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px,
                 const cv::Scalar& bgr, int thickness_px = 0);

// The colours of left and right limbs and of the trunk.
cv::Scalar left_colour();
cv::Scalar right_colour();
cv::Scalar trunk_colour();

// A line of text in the upper left corner, readable on any ground.
void draw_caption(cv::Mat& image, const std::string& text);

// Thickness that suits the image: 1 px at 480 lines, 2 at 960, …
int line_thickness(const cv::Mat& image);

}  // namespace io
}  // namespace walktrack
