// What of a camera's picture is shown in a video of it, and how large: the whole picture, or a
// window of constant size that follows the walker, shrunk so far that nothing is wider than wanted.
//
// Pixel centres are at integers; those of a shrunk picture lie between those of the picture it is
// made of (camera/camera.h, scaled_down).
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "body/pose.h"
#include "camera/camera.h"

namespace walktrack {
inline namespace io {

struct OverlayView {
  cv::Rect area;  // of the camera's picture, px
  cv::Size size;  // of what is shown of it, px; even, as encoders want it
};

// The whole picture, at most `width_px` wide; 0 = as it is.
OverlayView whole_view(const Camera& camera, int width_px);

// Windows that hold every known joint as far as it is in the picture, one a frame and all of one
// size. Where no joint is known they move from the window before to the one after. Small ones are
// enlarged to a height at which the figure can be looked at. The whole picture where no frame has a
// joint in it.
std::vector<OverlayView> views_around(const Camera& camera, std::span<const JointPositions> frames,
                                      int width_px);

// The camera whose picture the view is.
Camera camera_of(const OverlayView& view, const Camera& camera);
// Where a pixel of the camera's picture is in the view.
Eigen::Vector2d in_view(const OverlayView& view, const Eigen::Vector2d& px);

// 8-bit BGR of the view's size; `out` keeps its memory and never shares the picture's.
void look_through(const OverlayView& view, const cv::Mat& picture, cv::Mat& out);

}  // namespace io
}  // namespace walktrack
