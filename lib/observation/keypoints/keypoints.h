// What a pose network or a file of detections says about one picture: people, each with points that
// have names.
//
// The points are those of HALPE_26 (Fang et al., "AlphaPose", PAMI 2022) and in its order: the 17
// of COCO (Lin et al., ECCV 2014) followed by the top of the head, the neck, the middle of the hips
// and three points of each foot. OpenPose's BODY_25 has the same without the top of the head.
// "Left" is the person's own left, as the detector says: it may be wrong (keypoint_term.h).
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

// As a user writes them, for example in the map of a file whose points have names of their own.
inline constexpr std::array<std::string_view, kKeypointCount> kKeypointNames{
    "nose",         "left_eye",      "right_eye",      "left_ear",
    "right_ear",    "left_shoulder", "right_shoulder", "left_elbow",
    "right_elbow",  "left_wrist",    "right_wrist",    "left_hip",
    "right_hip",    "left_knee",     "right_knee",     "left_ankle",
    "right_ankle",  "head_top",      "neck",           "mid_hip",
    "left_big_toe", "right_big_toe", "left_small_toe", "right_small_toe",
    "left_heel",    "right_heel"};

// Pixels of the picture as it was recorded, its lens included and not shrunk; the centre of the top
// left pixel is (0, 0).
struct Keypoint {
  float x_px = 0, y_px = 0;
  float confidence = 0;  // the detector's, 0 to 1; 0 = missing. Larger values count as 1
};

struct DetectedPerson {
  std::array<Keypoint, kKeypointCount> points{};

  Keypoint& operator[](KeypointName name) { return points[static_cast<size_t>(name)]; }
  const Keypoint& operator[](KeypointName name) const { return points[static_cast<size_t>(name)]; }
};

// Of one picture; nobody when the detector saw nobody or was not asked: both say nothing.
using DetectedPeople = std::vector<DetectedPerson>;

}  // namespace observation
}  // namespace walktrack
