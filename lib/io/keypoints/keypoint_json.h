// The readers of JSON keypoints: OpenPose, COCO results and MMPose.
#pragma once

#include <filesystem>
#include <map>

#include "io/keypoints/json_value.h"
#include "io/keypoints/keypoint_file.h"

namespace walktrack {
inline namespace io {

KeypointFrames openpose_folder(const std::filesystem::path& folder);
KeypointFrames coco_results(const JsonValue& list);
KeypointFrames mmpose_inferences(const JsonValue& root);

// The OpenPose files of a folder, by frame. Throws an InputError if two are for the same frame.
std::map<int, std::filesystem::path> openpose_files(const std::filesystem::path& folder);

}  // namespace io
}  // namespace walktrack
