#include "observation/background/colourless.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace walktrack {
inline namespace observation {

namespace {

// Pictures are colourless if 99 in 100 pixels have less chroma than the first value at the usual
// brightness, grey levels. Of the videos at hand the palest, a white room, has 19
// (reports/colourless.md). The second is what noise and rounding leave in dark pictures. By hand.
constexpr float kColour = 15, kRoundedChroma = 4;

}  // namespace

bool is_colourless(std::span<float> chroma, float gain) {
  const auto high = chroma.begin() + static_cast<std::ptrdiff_t>(99 * chroma.size() / 100);
  std::nth_element(chroma.begin(), high, chroma.end());
  return *high < std::max(kColour / gain, kRoundedChroma);
}

cv::Mat without_colours(const cv::Mat& bgr) {
  cv::Mat grey, out;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(grey, out, cv::COLOR_GRAY2BGR);
  return out;
}

}  // namespace observation
}  // namespace walktrack
