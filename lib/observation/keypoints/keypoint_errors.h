// The errors of a detector's points, learned from the recording itself while it is tracked.
//
// For every kind of point: the scale of its error, as a running median, and its offset from the
// body model's point, as a regularised least-squares fit with exponential forgetting. Both are
// shares of the person's height, and the same left and right.
#pragma once

#include <array>
#include <cstdint>

#include "observation/keypoints/keypoint_points.h"

namespace walktrack {
inline namespace observation {

struct KeypointErrors {
  std::array<double, kPointKinds> scale;  // of one coordinate, at full confidence
  std::array<int64_t, kPointKinds> seen{};
  // The normal equations of the offsets, by kind: the matrix's upper half, and the right-hand side.
  std::array<std::array<double, 3>, kPointKinds> information{};
  std::array<std::array<double, 2>, kPointKinds> pull{};
};

// The initial errors: the disagreement of people who annotate COCO's images (sigma_i of its object
// keypoint similarity, Lin et al. 2014, times the object's size, .42 of a person's height).
// Detectors are more accurate on clear views and less on others.
KeypointErrors initial_errors();

// An offset and its standard deviation, forward and up, after the points seen so far.
struct PointOffset {
  Eigen::Vector2d mean, sd;
};
PointOffset offset_of(const KeypointErrors& errors, PointKind kind);
PointOffsets offsets_of(const KeypointErrors& errors);

// One matched point of a frame.
struct PointResidual {
  size_t point;
  Eigen::Vector2d px;             // detected minus predicted with the present offsets
  double scale_px;                // expected scale of the error
  Eigen::Matrix2d px_per_offset;  // pixel_per_offset()
};

// `dof` of the Student-t; `temper`: the number of independent residuals that one represents.
void learn(const PointResidual& residual, double dof, double temper, KeypointErrors& errors);

// To be called after each frame from whose points something was learned.
void forget(KeypointErrors& errors);

}  // namespace observation
}  // namespace walktrack
