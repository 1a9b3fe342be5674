#include "observation/background/levels.h"

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
// Pictures have little contrast if all their luma is in a smaller range than the first value, grey
// levels, which is then stretched to the second (reports/dark.md).
constexpr float kSmallRange = 190, kUsualRange = 224, kAllLevels = 255;
// Grey levels: telephones in a room have about so much noise, and where it would become larger it
// is noise, and not the fixed sizes, that hides people. Chosen in reports/dark.md.
constexpr float kUsualNoise = 0.75F;
constexpr float kLeastStretch = 1.1F;  // less is not worth a change; by hand
// Variance of the blur for each unit of gain above 1, px^2: with 4 times the values, noise that is
// independent from pixel to pixel is about as large as before. Chosen on the renders of
// reports/dark.md.
constexpr double kBlur = 0.5;

}  // namespace

Levels levels_of_dark(std::span<float> luma) {
  const auto high = luma.begin() + static_cast<std::ptrdiff_t>(9 * luma.size() / 10);
  std::nth_element(luma.begin(), high, luma.end());
  if (*high >= kDark) return {};
  return {0, std::min(kUsuallyBelow / std::max(*high, 1.F), kMostGain)};
}

void LumaRange::take(float luma) {
  lowest = std::min(lowest, luma);
  highest = std::max(highest, luma);
}

bool LumaRange::is_small() const {
  const float range = highest - lowest;
  return range >= 0 && range < kSmallRange;
}

Levels LumaRange::levels(float noise) const {
  if (!is_small()) return {};
  const float wanted = kUsualRange / std::max(highest - lowest, 1.F);
  const float gain = std::min({wanted, kUsualNoise / std::max(noise, 0.01F), kMostGain});
  if (gain < kLeastStretch) return {};
  return {std::max(0.F, (lowest + highest - kAllLevels / gain) / 2), gain};
}

cv::Mat stretched(const cv::Mat& bgr, const Levels& levels) {
  if (bgr.empty() || !levels.stretch()) return bgr;
  const auto gain = static_cast<double>(levels.gain);
  cv::Mat out;
  bgr.convertTo(out, -1, gain, -gain * static_cast<double>(levels.black));
  cv::GaussianBlur(out, out, {}, std::sqrt(kBlur * (gain - 1)));
  return out;
}

}  // namespace observation
}  // namespace walktrack
