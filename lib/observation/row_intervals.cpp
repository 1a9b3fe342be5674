#include "observation/row_intervals.h"

#include <algorithm>
#include <cmath>
#include <limits>

// Highway compiles this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "observation/row_intervals.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace walktrack::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

const hn::CappedTag<double, kRowVector / 2> kReal;
const hn::CappedTag<int32_t, kRowVector> kWhole;
const hn::Rebind<int32_t, decltype(kReal)> kNarrow;

int real_lanes() { return static_cast<int>(hn::Lanes(kReal)); }

// The outline's reach in each row of a block, px; the padding lets vectors begin at any row.
struct Reach {
  double left[kBlockRows + kRowVector], right[kBlockRows + kRowVector];
};

template <typename Mask, typename Vec>
HWY_ATTR void widen(Mask rows, Vec left, Vec right, double* lefts, double* rights) {
  const auto old_left = hn::LoadU(kReal, lefts), old_right = hn::LoadU(kReal, rights);
  hn::StoreU(hn::IfThenElse(rows, hn::Min(old_left, left), old_left), kReal, lefts);
  hn::StoreU(hn::IfThenElse(rows, hn::Max(old_right, right), old_right), kReal, rights);
}

HWY_ATTR void widen_by_disc(const Disc& disc, int block_row, BlockRows rows, Reach& reach) {
  const auto x = hn::Set(kReal, disc.centre.x());
  const auto square = hn::Set(kReal, disc.radius * disc.radius);
  const double top = block_row - disc.centre.y();
  for (int k = rows.from; k < rows.to; k += real_lanes()) {
    const auto dy = hn::Iota(kReal, top + k);
    const auto left_over = hn::Sub(square, hn::Mul(dy, dy));
    const auto half = hn::Sqrt(hn::Max(left_over, hn::Zero(kReal)));
    widen(hn::Ge(left_over, hn::Zero(kReal)), hn::Sub(x, half), hn::Add(x, half), reach.left + k,
          reach.right + k);
  }
}

HWY_ATTR void widen_by_edge(const Edge& edge, int block_row, BlockRows rows, Reach& reach) {
  const auto first = hn::Set(kReal, edge.first), last = hn::Set(kReal, edge.last);
  const auto x_at_0 = hn::Set(kReal, edge.x_at_0), slope = hn::Set(kReal, edge.slope);
  for (int k = rows.from; k < rows.to; k += real_lanes()) {
    const auto y = hn::Iota(kReal, static_cast<double>(block_row + k));
    const auto x = hn::Add(x_at_0, hn::Mul(slope, y));
    widen(hn::And(hn::Ge(y, first), hn::Le(y, last)), x, x, reach.left + k, reach.right + k);
  }
}

// Of the rows given, those between two heights in the image.
BlockRows rows_between(double first, double last, int block_row, BlockRows rows) {
  const double from = std::ceil(first) - block_row, to = std::floor(last) - block_row + 1;
  const auto clamped = [&](double row) {
    return static_cast<int>(std::clamp(row, double(rows.from), double(rows.to)));
  };
  return {clamped(from), clamped(to)};
}

// Columns whose centres lie between left and right.
HWY_ATTR void to_columns(const Reach& reach, const PixelRect& area, BlockRows rows,
                         RowIntervals& out) {
  const auto zero = hn::Zero(kReal), one = hn::Set(kReal, 1.0);
  const auto x0 = hn::Set(kReal, static_cast<double>(area.x0));
  const auto width = hn::Set(kReal, static_cast<double>(area.width()));
  const auto clamped = [&](auto x) HWY_ATTR { return hn::Min(width, hn::Max(zero, x)); };
  for (int k = rows.from; k < rows.to; k += real_lanes()) {
    const auto from = clamped(hn::Sub(hn::LoadU(kReal, reach.left + k), x0));
    const auto to = clamped(hn::Add(hn::Sub(hn::LoadU(kReal, reach.right + k), x0), one));
    const auto begin = hn::DemoteTo(kNarrow, hn::Ceil(from));
    const auto end = hn::DemoteTo(kNarrow, hn::Floor(to));
    const auto some = hn::Lt(begin, end);
    hn::StoreU(hn::IfThenElseZero(some, begin), kNarrow, out.begin + k);
    hn::StoreU(hn::IfThenElseZero(some, end), kNarrow, out.end + k);
  }
}

// Every piece of the outline lies in the convex hull, so the outermost of those that meet a row
// bound it there.
HWY_ATTR void cover_rows(const Outline& outline, const PixelRect& area, int block_row,
                         BlockRows rows, RowIntervals& out) {
  Reach reach;
  const BlockRows whole = whole_vectors(rows);
  std::fill(reach.left + whole.from, reach.left + whole.to + kRowVector,
            std::numeric_limits<double>::max());
  std::fill(reach.right + whole.from, reach.right + whole.to + kRowVector,
            std::numeric_limits<double>::lowest());
  for (const Disc& disc : outline.discs) {
    const double y = disc.centre.y();
    widen_by_disc(disc, block_row, rows_between(y - disc.radius, y + disc.radius, block_row, rows),
                  reach);
  }
  for (const Edge& edge : outline.edges)
    widen_by_edge(edge, block_row, rows_between(edge.first, edge.last, block_row, rows), reach);
  to_columns(reach, area, whole, out);
  std::fill(out.begin + rows.to, out.begin + whole.to, 0);  // the area may end before a vector does
  std::fill(out.end + rows.to, out.end + whole.to, 0);
}

using Whole = hn::Vec<decltype(kWhole)>;
using WholeMask = hn::Mask<decltype(kWhole)>;

struct Columns {
  Whole begin, end;
};

HWY_ATTR Columns load(const RowIntervals& rows, int k) {
  return {hn::Load(kWhole, rows.begin + k), hn::Load(kWhole, rows.end + k)};
}

HWY_ATTR void store(const Columns& columns, RowIntervals& rows, int k) {
  hn::Store(columns.begin, kWhole, rows.begin + k);
  hn::Store(columns.end, kWhole, rows.end + k);
}

// What `nearer` leaves of a piece. It begins after the piece begins, ends before the piece ends,
// both (then it lies within, and the part before it is what is left), or neither.
struct Left {
  Columns piece;
  WholeMask within;
};

HWY_ATTR Left left_of(const Columns& piece, const Columns& nearer) {
  const auto after = hn::Gt(nearer.begin, piece.begin), before = hn::Lt(nearer.end, piece.end);
  const auto within = hn::And(hn::And(after, before), hn::Lt(nearer.begin, nearer.end));
  const auto cut = hn::Or(hn::AndNot(before, after), within);
  return {{hn::IfThenElse(after, piece.begin, hn::Max(piece.begin, nearer.end)),
           hn::IfThenElse(cut, hn::Min(piece.end, nearer.begin), piece.end)},
          within};
}

HWY_ATTR uint64_t bits_of(WholeMask mask, int k) {
  uint8_t bits[8] = {};
  hn::StoreMaskBits(kWhole, mask, bits);
  return (uint64_t{bits[0]} | uint64_t{bits[1]} << 8) << k;
}

HWY_ATTR uint64_t hide_rows(const RowIntervals& nearer, BlockRows rows, SeenRows& seen) {
  const BlockRows whole = whole_vectors(rows);
  uint64_t too_many = 0;
  for (int k = whole.from; k < whole.to; k += static_cast<int>(hn::Lanes(kWhole))) {
    const Columns hidden = load(nearer, k), piece = load(seen.first, k);
    if (seen.two) {
      const Left other = left_of(load(seen.second, k), hidden);
      store(other.piece, seen.second, k);
      too_many |= bits_of(other.within, k);
    }
    const Left left = left_of(piece, hidden);
    store(left.piece, seen.first, k);
    if (hn::AllFalse(kWhole, left.within)) continue;
    const Columns second = load(seen.second, k);
    const auto taken = hn::And(left.within, hn::Lt(second.begin, second.end));
    store({hn::IfThenElse(left.within, hidden.end, second.begin),
           hn::IfThenElse(left.within, piece.end, second.end)},
          seen.second, k);
    too_many |= bits_of(taken, k);
    seen.two = true;
  }
  return too_many;
}

}  // namespace walktrack::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace walktrack {

namespace {

HWY_EXPORT(cover_rows);
HWY_EXPORT(hide_rows);

}  // namespace

void cover_rows(const Outline& outline, const PixelRect& area, int block_row, BlockRows rows,
                RowIntervals& out) {
  HWY_DYNAMIC_DISPATCH(cover_rows)(outline, area, block_row, rows, out);
}

void show_rows(const RowIntervals& covered, BlockRows rows, SeenRows& seen) {
  const BlockRows whole = whole_vectors(rows);
  std::copy(covered.begin + whole.from, covered.begin + whole.to, seen.first.begin + whole.from);
  std::copy(covered.end + whole.from, covered.end + whole.to, seen.first.end + whole.from);
  std::fill(seen.second.begin + whole.from, seen.second.begin + whole.to, 0);
  std::fill(seen.second.end + whole.from, seen.second.end + whole.to, 0);
  seen.two = false;
}

uint64_t hide_rows(const RowIntervals& nearer, BlockRows rows, SeenRows& seen) {
  return HWY_DYNAMIC_DISPATCH(hide_rows)(nearer, rows, seen);
}

}  // namespace walktrack
#endif
