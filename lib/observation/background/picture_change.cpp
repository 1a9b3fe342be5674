#include "observation/background/picture_change.h"

#include <opencv2/core.hpp>

namespace walktrack {
inline namespace observation {

cv::Mat changed(const cv::Mat& bgr, const PictureChange& change) {
  const cv::Mat bright = brightened(bgr, change.brightness);
  return change.colourless && !bright.empty() ? without_colours(bright) : bright;
}

}  // namespace observation
}  // namespace walktrack
