// What is done to all pictures of a camera before they are compared.
#pragma once

#include "observation/background/colourless.h"
#include "observation/background/levels.h"

namespace walktrack {
inline namespace observation {

struct PictureChange {
  Levels levels;            // of dark pictures and of little contrast (levels.h)
  bool colourless = false;  // whether chroma is set to zero (colourless.h)
};

// The changed 8-bit BGR picture; where nothing is done, the picture itself, not a copy.
cv::Mat changed(const cv::Mat& bgr, const PictureChange& change);

}  // namespace observation
}  // namespace walktrack
