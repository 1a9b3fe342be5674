// Which of a detector's points is which of ours, by how many it has.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "observation/keypoints/keypoints.h"

namespace walktrack {
inline namespace io {

// For each of the detector's points ours, or nothing for one that we have no name for: 25 BODY_25
// (Cao et al. 2019, OpenPose), 26 HALPE_26 (Fang et al. 2022), 18 COCO with a neck (OpenPose), 17
// COCO. Empty for any other number.
std::span<const std::optional<KeypointName>> skeleton_of(size_t points);

// What an error says is allowed: "17 (COCO), 18, 25 (BODY_25) or 26 (HALPE_26) points".
std::string skeletons_allowed();

}  // namespace io
}  // namespace walktrack
