// The correspondence of a detector's keypoints to points of the body, and their projection for a
// pose.
// The neck, the middle of the hips, the small toes and the top of the head are not used: their
// errors repeat those of shoulders, hips and feet.
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "camera/camera.h"
#include "observation/keypoints/keypoints.h"
#include "observation/term.h"

namespace walktrack {
inline namespace observation {

enum class PointKind { kHead, kShoulder, kElbow, kWrist, kHip, kKnee, kAnkle, kToe, kHeel };
inline constexpr size_t kPointKinds = 9;

// The head, then left and right of every other kind.
inline constexpr size_t kBodyPoints = 17;
inline constexpr size_t kFirstArmPoint = 1, kFirstLegPoint = 7;

inline constexpr PointKind kind_of(size_t point) { return static_cast<PointKind>((point + 1) / 2); }
inline constexpr size_t mirrored(size_t point) { return point == 0 ? 0 : 1 + ((point - 1) ^ 1); }
// Whether only a body with arms has this point.
inline constexpr bool needs_arms(PointKind kind) {
  return kind == PointKind::kElbow || kind == PointKind::kWrist;
}

// The offset of the detector's point from the body model's, by kind: forward and up in the axes of
// the limb that ends there, as shares of the body's height. It is the same on both sides.
using PointOffsets = std::array<Eigen::Vector2d, kPointKinds>;

// One detected person in pixels of a shrunk image.
struct SeenPoints {
  std::array<Eigen::Vector2d, kBodyPoints> px;
  std::array<double, kBodyPoints> confidence;  // 0 = missing
  double height_px = 0;  // height when standing, estimated from the points; 0 = unknown
};

// `arms`: whether the body has any. Points with a low confidence are missing.
SeenPoints seen_points(const DetectedPerson& person, int shrink, bool arms);

using PointPixels = std::array<Eigen::Vector2d, kBodyPoints>;

// Points behind the camera, and those that the body does not have, are far outside the image.
PointPixels point_pixels(const Camera& camera, const PosedBody& body, const PointOffsets& offsets);

// The change of a point with its kind's offset (columns: forward, up), px.
Eigen::Matrix2d pixel_per_offset(const Camera& camera, const PosedBody& body, size_t point,
                                 const PointOffsets& offsets);

}  // namespace observation
}  // namespace walktrack
