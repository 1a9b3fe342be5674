// Images shrunk by a whole factor: the pyramid of this module has one level, chosen per camera.
#pragma once

#include "camera/camera.h"

namespace cv {
class Mat;
}

namespace walktrack {
inline namespace observation {

// Area average over factor x factor pixels; rows and columns left over at the far edges are cut
// off. Pixel centres move as scaled_down() of camera/camera.h says.
cv::Mat shrunk(const cv::Mat& image, int factor);

// The largest factor at which something `height_px` high stays at least `wanted_px` high; >= 1.
int shrink_factor(double height_px, double wanted_px);

}  // namespace observation
}  // namespace walktrack
