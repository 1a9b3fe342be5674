// The correspondence between a detector's points and KeypointName, by the number of points.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "observation/keypoints/keypoints.h"

namespace walktrack {
inline namespace io {

// The keypoint for each of the detector's points, or nullopt for one that is not used: 25 BODY_25
// (Cao et al. 2019, OpenPose), 26 HALPE_26 (Fang et al. 2022), 18 COCO with a neck (OpenPose), 17
// COCO. Empty for any other number.
std::span<const std::optional<KeypointName>> skeleton_of(size_t points);

// The list of allowed skeletons for messages: "17 (COCO), 18, 25 (BODY_25) or 26 (HALPE_26)
// points".
std::string skeletons_allowed();

// A point as a file states it. It counts as missing if it has no confidence, is not finite, is
// outside of any image, or is exactly at the corner (0, 0).
Keypoint keypoint_from(double x, double y, double confidence);

}  // namespace io
}  // namespace walktrack
