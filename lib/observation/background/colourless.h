// Pictures without colours: of monochrome cameras, or nearly so. Their chroma tells
// nobody from the background, so that it is set to zero and only luma is compared.
#pragma once

#include <span>

namespace cv {
class Mat;
}

namespace walktrack {
inline namespace observation {

// Whether pictures have no colours, from the larger chroma of pixels, which is sorted in part, and
// the factor by which the pictures are stretched (levels.h).
bool is_colourless(std::span<float> chroma, float gain);

// The 8-bit BGR picture in grey.
cv::Mat without_colours(const cv::Mat& bgr);

}  // namespace observation
}  // namespace walktrack
