#include "observation/shrink.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace walktrack {
inline namespace observation {

cv::Mat shrunk(const cv::Mat& image, int factor) {
  if (factor == 1) return image;
  const int width = image.cols / factor, height = image.rows / factor;
  cv::Mat small;
  cv::resize(image(cv::Rect(0, 0, width * factor, height * factor)), small, cv::Size(width, height),
             0, 0, cv::INTER_AREA);
  return small;
}

int shrink_factor(double height_px, double wanted_px) {
  return std::max(1, static_cast<int>(height_px / wanted_px));
}

}  // namespace observation
}  // namespace walktrack
