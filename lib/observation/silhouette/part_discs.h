// The two discs that represent a part's ends in the image (observation/silhouette/capsules.h), for
// all parts of a body at once.
//
// Parts are the lanes of vectors: the code is compiled for every instruction set, and one is chosen
// at run time (Highway). Only sums, products, quotients and roots are used, each rounded according
// to IEEE 754, so that every instruction set gives the same discs.
#pragma once

#include <span>

#include "camera/camera.h"
#include "observation/silhouette/part_table.h"

namespace walktrack {
inline namespace observation {

// By part. In pixels of the given camera; depth along the optical axis, m.
struct PartDiscs {
  DiscTable lower, upper;
  alignas(64) double depth[kMaxParts];    // of the middle of the axis
  alignas(64) double nearest[kMaxParts];  // of the discs; if it is below kMinDepth the other values
                                          // are undefined
};

// Throws std::length_error for more than kMaxParts parts.
void find_discs(const Camera& camera, std::span<const PosedPart> parts, PartDiscs& out);

}  // namespace observation
}  // namespace walktrack
