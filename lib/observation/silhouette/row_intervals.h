// The columns of consecutive image rows that a capsule covers, and the rest of them that nearer
// capsules do not hide.
//
// Rows are the lanes of vectors: the code is compiled for every instruction set, and one is chosen
// at run time (Highway). Only additions, products, quotients and roots are used, each rounded
// according to IEEE 754, so that every instruction set gives the same columns.
#pragma once

#include <cstdint>

#include "observation/silhouette/outline.h"

namespace walktrack {
inline namespace observation {

// Rows are processed in blocks, so that all data about them have a fixed size, stay in the nearest
// cache, and have one bit for each row in one word.
inline constexpr int kBlockRows = 64;

// Rows from <= k < to of a block.
struct BlockRows {
  int from, to;
};

// Number of rows that may share a vector, for any instruction set.
inline constexpr int kRowVector = 16;

inline BlockRows whole_vectors(BlockRows rows) {
  return {rows.from / kRowVector * kRowVector,
          (rows.to + kRowVector - 1) / kRowVector * kRowVector};
}

// By row of a block: the columns begin <= x < end, counted from the area's left; empty if begin >=
// end. Rows outside the outline that share a vector with it are empty.
struct RowIntervals {
  alignas(64) int32_t begin[kBlockRows];
  alignas(64) int32_t end[kBlockRows];
};

// The columns of the pixel centres inside or on the outline of capsule `i`, in rows block_row +
// rows.from ...
void cover_rows(const Outlines& outlines, size_t i, const PixelRect& area, int block_row,
                BlockRows rows, RowIntervals& out);

// The visible part of a capsule in the rows of a block: at most two pieces in each, of which the
// second one is empty unless `two` is set.
struct SeenRows {
  RowIntervals first, second;
  bool two;
};

// Makes all of the capsule visible, in these rows and those that share a vector with them.
void show_rows(const RowIntervals& covered, BlockRows rows, SeenRows& seen);

// Removes `nearer` in these rows. Bit k of the result: in row k more than two pieces would be left,
// so that `seen` is invalid for that row.
uint64_t hide_rows(const RowIntervals& nearer, BlockRows rows, SeenRows& seen);

}  // namespace observation
}  // namespace walktrack
