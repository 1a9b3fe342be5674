#include "observation/background/picture_change.h"

#include <opencv2/core.hpp>

namespace walktrack {
inline namespace observation {

cv::Mat changed(const cv::Mat& bgr, const PictureChange& change) {
  const cv::Mat out = stretched(bgr, change.levels);
  return change.colourless && !out.empty() ? without_colours(out) : out;
}

}  // namespace observation
}  // namespace walktrack
