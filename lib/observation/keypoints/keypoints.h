// The result of a pose network or of a file of detections for one image: people with named points.
//
// The points are those of HALPE_26 (Fang et al., "AlphaPose", PAMI 2022) in its order: the 17 of
// COCO (Lin et al., ECCV 2014) followed by the top of the head, the neck, the middle of the hips
// and three points of each foot. OpenPose's BODY_25 has the same without the top of the head.
// "Left" is the person's left according to the detector, which may be wrong (keypoint_term.h).
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace walktrack {
inline namespace observation {

enum class KeypointName {
  kNose,
  kLeftEye,
  kRightEye,
  kLeftEar,
  kRightEar,
  kLeftShoulder,
  kRightShoulder,
  kLeftElbow,
  kRightElbow,
  kLeftWrist,
  kRightWrist,
  kLeftHip,
  kRightHip,
  kLeftKnee,
  kRightKnee,
  kLeftAnkle,
  kRightAnkle,
  kHeadTop,
  kNeck,    // middle of the shoulders, or the base of the neck: detectors differ
  kMidHip,  // middle of the hips
  kLeftBigToe,
  kRightBigToe,
  kLeftSmallToe,
  kRightSmallToe,
  kLeftHeel,
  kRightHeel,
};
inline constexpr size_t kKeypointCount = 26;

// The names in configurations, for example in the map for a file with names of its own.
inline constexpr std::array<std::string_view, kKeypointCount> kKeypointNames{
    "nose",         "left_eye",      "right_eye",      "left_ear",
    "right_ear",    "left_shoulder", "right_shoulder", "left_elbow",
    "right_elbow",  "left_wrist",    "right_wrist",    "left_hip",
    "right_hip",    "left_knee",     "right_knee",     "left_ankle",
    "right_ankle",  "head_top",      "neck",           "mid_hip",
    "left_big_toe", "right_big_toe", "left_small_toe", "right_small_toe",
    "left_heel",    "right_heel"};

// In pixels of the image as it was recorded, with its lens distortion and not shrunk; the centre of
// the top left pixel is (0, 0).
struct Keypoint {
  float x_px = 0, y_px = 0;
  float confidence = 0;  // the detector's, 0 to 1; 0 = missing. Larger values count as 1
};

struct DetectedPerson {
  std::array<Keypoint, kKeypointCount> points{};

  Keypoint& operator[](KeypointName name) { return points[static_cast<size_t>(name)]; }
  const Keypoint& operator[](KeypointName name) const { return points[static_cast<size_t>(name)]; }
};

// The people in one image; empty if the detector found nobody or was not run, neither of which is
// evidence.
using DetectedPeople = std::vector<DetectedPerson>;

}  // namespace observation
}  // namespace walktrack
