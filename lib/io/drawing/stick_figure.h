// Images of planar stick figures: a strip of postures as SVG and as an image, and an animation.
// Points are in metres, x forward, z up, the ground at z = 0; for a slope the image is rotated.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace walktrack {
inline namespace io {

struct StickLine {
  Eigen::Vector2d from, to;
  int group = 0;  // 0 trunk, 1 stance leg, 2 swing leg
};

struct StickFigure {
  double time = 0;  // s
  double x = 0;     // m, centre of the image
  std::vector<StickLine> lines;
};

// Figures side by side, each centred, with its time below it.
std::string strip_as_svg(const std::vector<StickFigure>& figures, double slope);
cv::Mat strip_as_image(const std::vector<StickFigure>& figures, double slope);

// One frame for each figure. The view moves with it over a ground with marks every half metre (for
// very large figures 5, 50, ... m).
void write_animation(const std::filesystem::path& path, const std::vector<StickFigure>& figures,
                     double slope, double frame_rate);

}  // namespace io
}  // namespace walktrack
