// Dark pictures, made as bright as others. Sizes in this module are in grey levels, and colours are
// counted in bins of 16 of them: in the dark, everybody would look like the background.
#pragma once

#include <span>

namespace cv {
class Mat;
}

namespace walktrack {
inline namespace observation {

inline constexpr float kMostBrightening = 8;  // leaves 32 grey levels; by hand

// The factor on the values of pictures, 1 to kMostBrightening, from their luma, grey levels, which
// is sorted in part: 1 unless nine tenths are below a third of the range.
float brightness_for(std::span<float> luma);

// The 8-bit picture with its values multiplied, where what exceeds the range is white. Its noise,
// which is multiplied as well, is reduced by a blur that grows from 0 at a brightness of 1. With
// that brightness it is the picture itself, not a copy.
cv::Mat brightened(const cv::Mat& bgr, float brightness);

}  // namespace observation
}  // namespace walktrack
