// People who are completely visible in images of a static camera: pixels that differ from the
// background, either in one piece or in the place where a pose network detects a person. Images may
// be shrunk first (shrink.h).
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
  // For images of this size; the background is that of shrunk ones.
  ForegroundMask(int width_px, int height_px, BackgroundModel background, int shrink, int threads);

  // Of a shrunk frame: 255 where the image differs from the background, without small specks and
  // gaps.
  cv::Mat of(const cv::Mat& frame);

 private:
  Observer observer_;
  CameraEvidence evidence_;
};

// Head and feet of a person, px of the image.
struct WholeFigure {
  double u_px, top_px, bottom_px;
};

// The pieces of a mask that can be complete people: of a person's height, higher than wide, and not
// cut off by the border of the image.
std::vector<WholeFigure> whole_figures(const cv::Mat& mask, int shrink);

// All of the mask where a person was detected, because a figure may be in pieces; nullopt if the
// head or the ankles were not detected, or if the foreground covers less than a complete person.
std::optional<WholeFigure> whole_figure_of(const DetectedPerson& person, const cv::Mat& mask,
                                           int shrink);

}  // namespace observation
}  // namespace walktrack
