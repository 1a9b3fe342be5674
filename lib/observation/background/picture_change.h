// What is done to all pictures of a camera before they are compared.
#pragma once

#include "observation/background/brightness.h"
#include "observation/background/colourless.h"

namespace walktrack {
inline namespace observation {

struct PictureChange {
  float brightness = 1;     // factor on dark pictures (brightness.h)
  bool colourless = false;  // whether chroma is set to zero (colourless.h)
};

// The changed 8-bit BGR picture; where nothing is done, the picture itself, not a copy.
cv::Mat changed(const cv::Mat& bgr, const PictureChange& change);

}  // namespace observation
}  // namespace walktrack
