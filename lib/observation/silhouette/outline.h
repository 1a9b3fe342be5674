// The outlines of capsules in the image, prepared for evaluation row by row: two discs each, and
// the two straight edges that touch both.
//
// Capsules are the lanes of vectors: the code is compiled for every instruction set, and one is
// chosen at run time (Highway). Only sums, products, quotients and roots are used, each rounded
// according to IEEE 754, so that every instruction set gives the same outlines.
#pragma once

#include <cstdint>

#include "observation/silhouette/capsules.h"
#include "observation/silhouette/planes.h"

namespace walktrack {
inline namespace observation {

// By capsule: the line x = x_at_0 + slope y for first <= y <= last; empty if first > last.
struct EdgeTable {
  alignas(64) double first[kMaxParts], last[kMaxParts], x_at_0[kMaxParts], slope[kMaxParts];
};

// In the order of a list of capsules.
struct Outlines {
  DiscTable discs[2];
  EdgeTable edges[2];
  // Rows of the area whose pixel centres the capsule may cover, without end_row; first_row >=
  // end_row if there are none.
  alignas(64) int32_t first_row[kMaxParts], end_row[kMaxParts];
};

void find_outlines(const CapsuleList& capsules, const PixelRect& area, Outlines& out);

}  // namespace observation
}  // namespace walktrack
