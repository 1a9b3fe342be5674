// Shrinks a decoded picture before it is converted to colours, which spares the conversion and a
// copy of the whole picture.
#pragma once

#include <array>
#include <cstdint>

#include <opencv2/core/mat.hpp>

namespace walktrack {
inline namespace io {

// A picture as decoders return it: 8 bits of brightness for each pixel, and the two differences of
// colour (U, V) for every 2 x 2 of them (YUV 4:2:0, ITU-R BT.601).
struct ColourPlanes {
  std::array<const uint8_t*, 3> first;  // Y, U, V
  std::array<int, 3> stride;            // bytes from row to row
  bool full_range = false;              // Y is 0 to 255, not 16 to 235
};

// The largest factor for which sums of a column are exact.
inline constexpr int kMostMeaned = 128;

// 8-bit BGR: means over shrink x shrink pixels of `area`, which is part of the picture; a remainder
// at its right and lower border is cut off. 2 <= shrink <= kMostMeaned. Within rounding the same as
// means of the converted pixels, as far as their colours exist.
void mean_colours(const ColourPlanes& planes, const cv::Rect& area, int shrink, cv::Mat& bgr);

}  // namespace io
}  // namespace walktrack
