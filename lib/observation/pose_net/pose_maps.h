// Decodes the maps of MoveNet's last layers for a cut-out into the points of a person.
//
// A map has side x side cells of 4 px of the cut-out. For each cell it states whether a person's
// middle is there (centre), whether each of the 17 points of COCO is (heat), both before the
// logistic function; the offset of each point from the person's middle (regress), and from the
// cell's corner (offset), as (y, x) in cells. Channels are stored one after the other, row by row.
//
//   middle  = argmax over cells of  sigmoid(centre) / (distance to the map's middle + 1.8)
//   point k = argmax over cells of  sigmoid(heat_k) / (distance to middle + regress_k + 1.8)
//   its place is that cell + offset_k, its confidence sigmoid(heat_k) there.
// (This is Google's published graph, except for its fixed table of weights for the middle.)
#pragma once

#include <span>

#include <opencv2/core/types.hpp>

#include "observation/keypoints/keypoints.h"

namespace walktrack {
inline namespace observation {

inline constexpr size_t kCocoPoints = 17;
inline constexpr int kCell_px = 4;

struct PoseMaps {
  int side = 0;  // cells
  std::span<const float> centre, heat, regress, offset;
};

// A square part of an image, px; it may extend beyond the image.
struct CutOut {
  int x0 = 0, y0 = 0, side_px = 0;
};

inline cv::Rect rectangle(const CutOut& cut_out) {
  return {cut_out.x0, cut_out.y0, cut_out.side_px, cut_out.side_px};
}

// The part of it that is in an image of that size.
inline cv::Rect part_within(const CutOut& cut_out, int width_px, int height_px) {
  return rectangle(cut_out) & cv::Rect(0, 0, width_px, height_px);
}

// In pixels of the image.
DetectedPerson decoded(const PoseMaps& maps, const CutOut& cut_out);

}  // namespace observation
}  // namespace walktrack
