// The keypoints of one camera's video, in the formats of common pose detectors:
//   OpenPose JSON   a folder with one file a frame (also from Pose2Sim, Sports2D and their
//                   converters); the last number in a file's name is the frame
//   COCO results    one JSON file (AlphaPose, Ultralytics, Detectron2); the number in `image_id`
//   MMPose JSON     one file of its inferencer; `frame_id`, from 1
//   DeepLabCut CSV  names of body parts are the user's own: a map names those that are ours
// Formats are recognised by content; the skeleton follows from the number of points (17, 18, 25,
// 26).
//
// Frames count from 0 at the first one of the video. Errors are InputErrors that name the file and
// the place in it, what was found and what is allowed.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "observation/keypoints/keypoints.h"

namespace walktrack {
inline namespace io {

struct KeypointSource {
  std::filesystem::path path{};  // empty = none
  // The file's name for each of the keypoints (kKeypointNames); DeepLabCut only.
  std::map<std::string, std::string> names{};
};

struct KeypointFrames {
  std::string format{};  // the format that was recognised
  int points = 0;        // of each person in the file
  // By frame. A frame in which nobody was detected is present and empty; a frame that the file does
  // not mention is missing. COCO results do not distinguish the two.
  std::map<int, DetectedPeople> people{};
};

KeypointFrames read_keypoints(const KeypointSource& source);

// Throws an InputError if the keypoints are not in the camera's pixels (another image size, shares
// of the image, rotated images).
void check_image_size(const KeypointFrames& frames, const KeypointSource& source,
                      const Camera& camera);

// Irregularities that are not errors, one sentence each: frames that are missing between others,
// and more or fewer frames than the video has (0 = unknown).
std::vector<std::string> keypoint_notes(const KeypointFrames& frames, int video_frames);

// The files with keypoints, in the order of their names: the file itself or those in the folder.
std::vector<std::filesystem::path> keypoint_files(const KeypointSource& source);

inline constexpr size_t kMaxKeypointBytes = size_t{256} << 20;  // of a file

}  // namespace io
}  // namespace walktrack
