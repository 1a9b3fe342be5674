// The part of a camera's image that an overlay video shows, and its scale: the whole image, or a
// window of constant size that follows the subject, shrunk to the width that is wanted.
//
// Pixel centres are at integers; those of a shrunk image lie between those of the original
// (camera/camera.h, scaled_down).
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "body/pose.h"
#include "camera/camera.h"
#include "io/video/video.h"

namespace walktrack {
inline namespace io {

struct OverlayView {
  cv::Rect area;  // of the camera's image, px
  cv::Size size;  // of the view, px; even, as encoders require
};

// The whole image, at most `width_px` wide; 0 = unchanged.
OverlayView whole_view(const Camera& camera, int width_px);

// Windows that contain all known joints as far as they are in the image, one for each frame and all
// of one size. In frames without known joints the window is interpolated. Small windows are
// enlarged to a height at which the figure is visible. If no frame has a joint in the image, the
// view is the whole image.
std::vector<OverlayView> views_around(const Camera& camera, std::span<const JointPositions> frames,
                                      int width_px);

// The camera for which the view is the whole image.
Camera camera_of(const OverlayView& view, const Camera& camera);
// The position of a pixel of the camera's image in the view.
Eigen::Vector2d in_view(const OverlayView& view, const Eigen::Vector2d& px);

// The view of the frame that the video is at: 8-bit BGR of its size. `out` keeps its memory.
void look_through(const OverlayView& view, const FrameSource& video, cv::Mat& out);

}  // namespace io
}  // namespace walktrack
