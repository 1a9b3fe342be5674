// The pixels of people in a picture, from the points of a pose detector.
#pragma once

#include <opencv2/core/mat.hpp>

#include "observation/keypoints/keypoints.h"

namespace walktrack {
inline namespace observation {

// 8-bit, 255 where somebody is and 0 elsewhere, of a picture of the given size: around each person
// the convex hull of their points, widened by what limbs, hair, clothes and a shadow at the feet
// are wide, and made longer where points leave off (the top of the head, the toes). Points of the
// same pixels as the picture's.
cv::Mat people_mask(const DetectedPeople& people, cv::Size size);

}  // namespace observation
}  // namespace walktrack
