// What a pose detector saw of one camera, as the usual programs write it:
//   OpenPose JSON   a folder with one file a frame (also from Pose2Sim, Sports2D and their
//                   converters); the last number in a file's name is the frame
//   COCO results    one JSON file (AlphaPose, Ultralytics, Detectron2); the number in `image_id`
//   MMPose JSON     one file of its inferencer; `frame_id`, from 1
//   DeepLabCut CSV  names of body parts are the user's own: a map names those that are ours
// Told apart by content; which point is which follows from how many there are (17, 18, 25, 26).
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
  // The name that the file has for each of our points (kKeypointNames); DeepLabCut only.
  std::map<std::string, std::string> names{};
};

struct KeypointFrames {
  std::string format{};  // what it was taken for
  int points = 0;        // of a person, in the file
  // By frame; a frame in which the file has nobody is there and empty, one that the file does not
  // speak of is missing. COCO results do not tell the two apart.
  std::map<int, DetectedPeople> people{};
};

KeypointFrames read_keypoints(const KeypointSource& source);

// Keypoints that are not in the camera's pixels (another image size, shares of the image, turned
// pictures) are an InputError.
void check_image_size(const KeypointFrames& frames, const KeypointSource& source,
                      const Camera& camera);

// What is odd and yet no error, one plain sentence each: frames that are left out between others,
// and more or fewer frames than the video's (0 = not known).
std::vector<std::string> keypoint_notes(const KeypointFrames& frames, int video_frames);

// The files that hold them, in order of their names: the file itself or those of the folder.
std::vector<std::filesystem::path> keypoint_files(const KeypointSource& source);

inline constexpr size_t kMaxKeypointBytes = size_t{256} << 20;  // of a file

}  // namespace io
}  // namespace walktrack
