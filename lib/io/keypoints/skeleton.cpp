#include "io/keypoints/skeleton.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace walktrack {
inline namespace io {

namespace {

using enum KeypointName;
using Point = std::optional<KeypointName>;

constexpr double kFarthest_px = 1e6;  // limit of coordinates in any image

constexpr std::array<Point, 26> kHalpe26{
    kNose,          kLeftEye,   kRightEye,   kLeftEar,     kRightEar,     kLeftShoulder,
    kRightShoulder, kLeftElbow, kRightElbow, kLeftWrist,   kRightWrist,   kLeftHip,
    kRightHip,      kLeftKnee,  kRightKnee,  kLeftAnkle,   kRightAnkle,   kHeadTop,
    kNeck,          kMidHip,    kLeftBigToe, kRightBigToe, kLeftSmallToe, kRightSmallToe,
    kLeftHeel,      kRightHeel};

constexpr std::array<Point, 25> kBody25{
    kNose,         kNeck,       kRightShoulder, kRightElbow,    kRightWrist,
    kLeftShoulder, kLeftElbow,  kLeftWrist,     kMidHip,        kRightHip,
    kRightKnee,    kRightAnkle, kLeftHip,       kLeftKnee,      kLeftAnkle,
    kRightEye,     kLeftEye,    kRightEar,      kLeftEar,       kLeftBigToe,
    kLeftSmallToe, kLeftHeel,   kRightBigToe,   kRightSmallToe, kRightHeel};

constexpr std::array<Point, 18> kCoco18{
    kNose,      kNeck,      kRightShoulder, kRightElbow, kRightWrist, kLeftShoulder,
    kLeftElbow, kLeftWrist, kRightHip,      kRightKnee,  kRightAnkle, kLeftHip,
    kLeftKnee,  kLeftAnkle, kRightEye,      kLeftEye,    kRightEar,   kLeftEar};

constexpr size_t kCoco = 17;  // the first points of HALPE_26

}  // namespace

std::span<const Point> skeleton_of(size_t points) {
  if (points == kCoco) return std::span(kHalpe26).first(kCoco);
  if (points == kCoco18.size()) return kCoco18;
  if (points == kBody25.size()) return kBody25;
  if (points == kHalpe26.size()) return kHalpe26;
  return {};
}

std::string skeletons_allowed() { return "17 (COCO), 18, 25 (BODY_25) or 26 (HALPE_26) points"; }

Keypoint keypoint_from(double x, double y, double confidence) {
  const bool corner = x == 0 && y == 0;
  const bool reachable = std::abs(x) <= kFarthest_px && std::abs(y) <= kFarthest_px;
  if (!(confidence > 0) || !reachable || corner) return {};
  return {static_cast<float>(x), static_cast<float>(y),
          static_cast<float>(std::min(confidence, 1.0))};
}

}  // namespace io
}  // namespace walktrack
