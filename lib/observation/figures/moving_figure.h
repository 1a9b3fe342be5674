// A fast search for moving figures in a video: in each frame the largest blob that differs from the
// median frame.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace walktrack {
inline namespace observation {

// The moving figure of one frame, px of the full image.
struct MovingFigure {
  Eigen::Vector2d middle;                      // of its upper part
  std::vector<Eigen::Vector2d> tops, bottoms;  // of its columns; empty if the image cuts it off
};
// By frame; nullopt if nothing or too much moves, or if there was no frame.
using FigurePath = std::vector<std::optional<MovingFigure>>;

// The frames of one camera, grey and small: at most 400 kB each.
class MovingFigures {
 public:
  // For images of this size.
  MovingFigures(int width_px, int height_px);

  // The factor by which frames are to be shrunk (shrink.h).
  int shrink() const { return factor_; }
  // Adds a frame, 8-bit BGR, shrunk; empty if the camera had no frame of its own.
  void add(const cv::Mat& frame);
  FigurePath path() const;

 private:
  int factor_;
  std::vector<cv::Mat> frames_;
};

}  // namespace observation
}  // namespace walktrack
