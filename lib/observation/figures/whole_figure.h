// People who are wholly visible in a picture of a camera that stands still: pixels that differ from
// the background, in one piece or where a pose network detects a person. Pictures may be shrunk
// first (shrink.h).
#pragma once

#include <optional>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "observation/keypoints/keypoints.h"
#include "observation/observer.h"

namespace walktrack {
inline namespace observation {

class ForegroundMask {
 public:
  // Of pictures of this size; the background is of shrunk ones.
  ForegroundMask(int width_px, int height_px, BackgroundModel background, int shrink, int threads);

  // 255 where the picture does not look like the background; shrunk. Specks are left out, gaps
  // closed.
  cv::Mat of(const cv::Mat& frame);

 private:
  Observer observer_;
  CameraEvidence evidence_;
};

// Head and feet of somebody, px of the picture.
struct WholeFigure {
  double u_px, top_px, bottom_px;
};

// The pieces of a mask that can be whole people: as high as one, higher than wide, not cut off by
// the picture's edge.
std::vector<WholeFigure> whole_figures(const cv::Mat& mask, int shrink);

// All of the mask that lies where a person was detected, because a figure may be in pieces; nothing
// if the head or the ankles were not detected, or if less of the person stands out than of a whole
// figure.
std::optional<WholeFigure> whole_figure_of(const DetectedPerson& person, const cv::Mat& mask,
                                           int shrink);

}  // namespace observation
}  // namespace walktrack
