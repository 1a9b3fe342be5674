// The readers behind keypoint_file.h, one for each format, and what they share.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/keypoints/json_value.h"
#include "io/keypoints/keypoint_file.h"

namespace walktrack {
inline namespace io {

// A point as a file has it. Missing: no confidence, no number, one that no picture reaches, or
// exactly the corner (0, 0).
Keypoint keypoint_from(double x, double y, double confidence);

// One person from as many x, y, confidence as a skeleton has points. `points` is what the people
// before had (0 = none yet): all of a file have the same.
DetectedPerson person_from(const std::vector<double>& triples, int& points, const JsonValue& place);

KeypointFrames openpose_folder(const std::filesystem::path& folder);
KeypointFrames coco_results(const JsonValue& list);
KeypointFrames mmpose_inferences(const JsonValue& root);
KeypointFrames deeplabcut_table(const std::string& text, const KeypointSource& source);

// Names of a folder's OpenPose files, by frame. InputError if two are the same frame's.
std::map<int, std::filesystem::path> openpose_files(const std::filesystem::path& folder);

}  // namespace io
}  // namespace walktrack
