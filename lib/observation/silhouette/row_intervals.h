// Which columns of consecutive image rows a capsule covers, and what nearer capsules leave of them.
//
// Rows are the lanes of vectors: compiled for every instruction set and chosen when the program
// runs (Highway). Only additions, products, quotients and roots are used, each rounded as IEEE 754
// says, so that every instruction set gives the same columns.
#pragma once

#include <cstdint>

#include "observation/silhouette/outline.h"

namespace walktrack {
inline namespace observation {

// Rows are worked on in blocks, so that all that is known about them has a fixed size, stays in the
// nearest cache, and has a bit for each row in one word.
inline constexpr int kBlockRows = 64;

// Rows from <= k < to of a block.
struct BlockRows {
  int from, to;
};

// Rows that may share a vector, whatever the instruction set.
inline constexpr int kRowVector = 16;

inline BlockRows whole_vectors(BlockRows rows) {
  return {rows.from / kRowVector * kRowVector,
          (rows.to + kRowVector - 1) / kRowVector * kRowVector};
}

// By row of a block: the columns begin <= x < end, counted from the area's left; none where begin
// >= end. Of the rows outside the outline, those that share a vector with it hold none.
struct RowIntervals {
  alignas(64) int32_t begin[kBlockRows];
  alignas(64) int32_t end[kBlockRows];
};

// The columns of the pixel centres inside or on the outline, in rows block_row + rows.from ...
void cover_rows(const Outline& outline, const PixelRect& area, int block_row, BlockRows rows,
                RowIntervals& out);

// What is seen of a capsule in the rows of a block: in each at most two pieces, the second one
// empty while `two` is not set.
struct SeenRows {
  RowIntervals first, second;
  bool two;
};

// All of the capsule, in these rows and those that share a vector with them.
void show_rows(const RowIntervals& covered, BlockRows rows, SeenRows& seen);

// Takes `nearer` away in these rows. Bit k of the answer: in row k this would leave more than two
// pieces, and what `seen` says of that row means nothing any more.
uint64_t hide_rows(const RowIntervals& nearer, BlockRows rows, SeenRows& seen);

}  // namespace observation
}  // namespace walktrack
