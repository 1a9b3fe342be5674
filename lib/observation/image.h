// The types of images for code that only passes them along, which therefore need not name OpenCV.
// Images are 8-bit, BGR unless stated otherwise; copies share their pixels.
#pragma once

#include <opencv2/core/mat.hpp>

namespace walktrack {
inline namespace observation {

using Image = cv::Mat;
using PixelSize = cv::Size;      // width, height
using ImageColour = cv::Scalar;  // blue, green, red, 0 to 255

}  // namespace observation
}  // namespace walktrack
