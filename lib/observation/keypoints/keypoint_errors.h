// How a detector's points err, learnt from the recording itself while it is tracked.
//
// Of every kind of point: the scale of its error, as a running median, and where on the body the
// detector sees it, as a regularised least-squares fit that forgets slowly. Both in shares of the
// person's height, the same left and right.
#pragma once

#include <array>
#include <cstdint>

#include "observation/keypoints/keypoint_points.h"

namespace walktrack {
inline namespace observation {

struct KeypointErrors {
  std::array<double, kPointKinds> scale;  // of one coordinate, at full confidence
  std::array<int64_t, kPointKinds> seen{};
  // Of the offsets' normal equations, by kind: the matrix's upper half, and the right-hand side.
  std::array<std::array<double, 3>, kPointKinds> information{};
  std::array<std::array<double, 2>, kPointKinds> pull{};
};

// Before anything has been seen: what people differ by who mark COCO's pictures (sigma_i of its
// object keypoint similarity, Lin et al. 2014, times the object's size, .42 of a person's height).
// Detectors do better on clear views and worse on others.
KeypointErrors initial_errors();

PointOffsets offsets_of(const KeypointErrors& errors);

// One matched point of a frame.
struct PointResidual {
  size_t point;
  Eigen::Vector2d px;             // detected minus predicted with the offsets so far
  double scale_px;                // of the error, as it was expected
  Eigen::Matrix2d px_per_offset;  // pixel_per_offset()
};

// `dof` of the Student-t; `temper`: a residual counts as so many independent ones.
void learn(const PointResidual& residual, double dof, double temper, KeypointErrors& errors);

// After each frame.
void forget(KeypointErrors& errors);

}  // namespace observation
}  // namespace walktrack
