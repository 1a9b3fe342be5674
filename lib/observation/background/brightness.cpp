#include "observation/background/brightness.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace walktrack {
inline namespace observation {

namespace {

// Pictures are dark if nine tenths of the pixels are darker than the first value, grey levels, and
// are then made so bright that nine tenths are darker than the second. In every video at hand that
// was taken by day or with lamps a tenth is brighter than 139 (reports/dark.md).
constexpr float kDark = 85, kUsuallyBelow = 128;
// Variance of the blur for each unit of brightness above 1, px^2: with 4 times the values, noise
// that is independent from pixel to pixel is about as large as before. Chosen on the renders of
// reports/dark.md.
constexpr double kBlur = 0.5;

}  // namespace

float brightness_for(std::span<float> luma) {
  const auto high = luma.begin() + static_cast<std::ptrdiff_t>(9 * luma.size() / 10);
  std::nth_element(luma.begin(), high, luma.end());
  if (*high >= kDark) return 1;
  return std::min(kUsuallyBelow / std::max(*high, 1.F), kMostBrightening);
}

cv::Mat brightened(const cv::Mat& bgr, float brightness) {
  if (bgr.empty() || brightness <= 1) return bgr;
  cv::Mat out;
  bgr.convertTo(out, -1, static_cast<double>(brightness));
  cv::GaussianBlur(out, out, {}, std::sqrt(kBlur * (static_cast<double>(brightness) - 1)));
  return out;
}

}  // namespace observation
}  // namespace walktrack
