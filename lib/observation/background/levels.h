// Pictures that use few of their grey levels, dark ones or those of little contrast, stretched over
// more of them. Sizes in this module are in grey levels, and colours are counted in bins of 16 of
// them: in the dark or in a haze, everybody would look like the background.
#pragma once

#include <limits>
#include <span>

namespace cv {
class Mat;
}

namespace walktrack {
inline namespace observation {

inline constexpr float kMostGain = 8;  // leaves 32 grey levels; by hand

// A value becomes gain (value - black).
struct Levels {
  float black = 0;  // grey levels, 0 to 255
  float gain = 1;   // 1 to kMostGain
  bool stretch() const { return gain > 1; }
};

// What makes dark pictures as bright as others, from the luma of their pixels, which is sorted in
// part.
Levels levels_of_dark(std::span<float> luma);

// The range of the luma of pictures, grey levels.
struct LumaRange {
  float lowest = std::numeric_limits<float>::infinity(), highest = -lowest;
  void take(float luma);
  // Whether it is so small that the pictures have little contrast.
  bool is_small() const;
  // What makes pictures of little contrast use most of their levels, as far as their `noise`, a
  // standard deviation in grey levels, does not become larger than is usual.
  Levels levels(float noise) const;
};

// The 8-bit picture at those levels, where what exceeds the range is black or white. Its noise,
// which is multiplied as well, is reduced by a blur that grows from 0 at a gain of 1. With that
// gain it is the picture itself, not a copy.
cv::Mat stretched(const cv::Mat& bgr, const Levels& levels);

}  // namespace observation
}  // namespace walktrack
