// The pixels of people in an image, from the points of a pose detector.
#pragma once

#include <opencv2/core/mat.hpp>

#include "observation/keypoints/keypoints.h"

namespace walktrack {
inline namespace observation {

// An 8-bit mask of the given size, 255 on people and 0 elsewhere: around each person the convex
// hull of their points, widened for limbs, hair, clothes and the shadow at the feet, and extended
// at its ends (the top of the head, the toes). Points are in pixels of the same image.
cv::Mat people_mask(const DetectedPeople& people, cv::Size size);

}  // namespace observation
}  // namespace walktrack
