// The visible silhouette of a body, run by run: which capsule is visible in which pixels of a row.
//
// A pixel belongs to the nearest capsule that covers its centre. Rows are processed in blocks, as
// vectors (row_intervals.h); nothing is allocated.
#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "observation/silhouette/row_intervals.h"

namespace walktrack {
inline namespace observation {

// Every capsule of a list, nearest first, with the rows of one block that it covers.
struct SilhouetteBlock {
  Outlines outlines;
  std::array<RowIntervals, kMaxCapsules> covered;
  std::array<BlockRows, kMaxCapsules> rows;
  int first_row;  // of the block, in the image
};

inline BlockRows rows_of_block(const Outlines& outlines, size_t i, int block_row) {
  return {std::max(outlines.first_row[i] - block_row, 0),
          std::min(outlines.end_row[i] - block_row, kBlockRows)};
}

// Calls visit(begin, end) for every visible piece of capsule `i` in row k.
template <typename Visit>
void visit_pieces_of_row(const SilhouetteBlock& block, size_t i, int k, Visit&& visit) {
  struct Piece {
    int begin, end;
  };
  std::array<Piece, kMaxCapsules + 1> pieces;
  pieces[0] = {block.covered[i].begin[k], block.covered[i].end[k]};
  size_t count = 1;
  for (size_t j = 0; j < i; ++j) {
    if (k < block.rows[j].from || k >= block.rows[j].to) continue;
    const int from = block.covered[j].begin[k], to = block.covered[j].end[k];
    if (from >= to) continue;
    for (size_t p = 0, known = count; p < known; ++p) {
      auto& [begin, end] = pieces[p];
      if (to <= begin || from >= end) continue;
      if (to < end && from > begin) pieces[count++] = {to, end};
      from > begin ? end = from : begin = std::min(to, end);
    }
  }
  for (size_t p = 0; p < count; ++p) visit(pieces[p].begin, pieces[p].end);
}

// Calls visit(k, begin, end) for the visible pieces of capsule `i` in the rows of the block; also
// for rows in which none is left, with begin >= end.
template <typename Visit>
void visit_seen_rows(const SilhouetteBlock& block, size_t i, Visit&& visit) {
  const BlockRows own = block.rows[i];
  SeenRows seen;
  show_rows(block.covered[i], own, seen);
  uint64_t too_many = 0;
  for (size_t j = 0; j < i; ++j) {
    const BlockRows shared{std::max(own.from, block.rows[j].from),
                           std::min(own.to, block.rows[j].to)};
    if (shared.from < shared.to) too_many |= hide_rows(block.covered[j], shared, seen);
  }
  for (; too_many != 0; too_many &= too_many - 1) {
    const int k = std::countr_zero(too_many);
    seen.first.end[k] = seen.first.begin[k];
    seen.second.end[k] = seen.second.begin[k];
    visit_pieces_of_row(block, i, k, [&](int begin, int end) { visit(k, begin, end); });
  }
  for (int k = own.from; k < own.to; ++k) visit(k, seen.first.begin[k], seen.first.end[k]);
  if (!seen.two) return;
  for (int k = own.from; k < own.to; ++k) visit(k, seen.second.begin[k], seen.second.end[k]);
}

// Calls visit(row, begin, end, capsule) for every visible run, with columns counted from area.x0;
// also for rows in which nothing of the capsule is left, with begin >= end.
template <typename Visit>
void visit_visible(const PixelRect& area, const CapsuleList& capsules, Visit&& visit) {
  SilhouetteBlock block;
  Outlines& outlines = block.outlines;
  find_outlines(capsules, area, outlines);
  int first = area.y1, end = area.y0;
  for (size_t i = 0; i < capsules.size(); ++i) {
    if (outlines.first_row[i] >= outlines.end_row[i]) continue;
    first = std::min(first, outlines.first_row[i]);
    end = std::max(end, outlines.end_row[i]);
  }
  for (block.first_row = first; block.first_row < end; block.first_row += kBlockRows) {
    for (size_t i = 0; i < capsules.size(); ++i) {
      block.rows[i] = rows_of_block(outlines, i, block.first_row);
      if (block.rows[i].from >= block.rows[i].to) continue;
      cover_rows(outlines, i, area, block.first_row, block.rows[i], block.covered[i]);
      visit_seen_rows(block, i,
                      [&](int k, int from, int to) { visit(block.first_row + k, from, to, i); });
    }
  }
}

}  // namespace observation
}  // namespace walktrack
