// The readers of keypoint_file.h, one for each format, and functions that they share.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/keypoints/json_value.h"
#include "io/keypoints/keypoint_file.h"

namespace walktrack {
inline namespace io {

// A point as a file states it. It counts as missing if it has no confidence, is not finite, is
// outside of any image, or is exactly at the corner (0, 0).
Keypoint keypoint_from(double x, double y, double confidence);

// One person from x, y, confidence of each point of a skeleton. `points` is the number of points of
// the earlier people in the file (0 = none yet), which must be the same.
DetectedPerson person_from(const std::vector<double>& triples, int& points, const JsonValue& place);

KeypointFrames openpose_folder(const std::filesystem::path& folder);
KeypointFrames coco_results(const JsonValue& list);
KeypointFrames mmpose_inferences(const JsonValue& root);
KeypointFrames deeplabcut_table(const std::string& text, const KeypointSource& source);

// The OpenPose files of a folder, by frame. Throws an InputError if two are for the same frame.
std::map<int, std::filesystem::path> openpose_files(const std::filesystem::path& folder);

}  // namespace io
}  // namespace walktrack
