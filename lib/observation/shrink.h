// Shrinks images by an integer factor: the image pyramid of this module has one level, which is
// chosen for each camera.
#pragma once

#include "camera/camera.h"

namespace cv {
class Mat;
}

namespace walktrack {
inline namespace observation {

// Area average over factor x factor pixels; remaining rows and columns at the far borders are cut
// off. Pixel centres move as in scaled_down() of camera/camera.h.
cv::Mat shrunk(const cv::Mat& image, int factor);

// The largest factor for which something `height_px` high is still at least `wanted_px` high; >= 1.
int shrink_factor(double height_px, double wanted_px);

}  // namespace observation
}  // namespace walktrack
