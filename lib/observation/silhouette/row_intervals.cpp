#include "observation/silhouette/row_intervals.h"

#include <algorithm>
#include <limits>

// Highway compiles this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "observation/silhouette/row_intervals.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace walktrack {
inline namespace observation {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

const hn::CappedTag<double, kRowVector / 2> kReal;
const hn::CappedTag<int32_t, kRowVector> kWhole;
const hn::Rebind<int32_t, decltype(kReal)> kNarrow;

int real_lanes() { return static_cast<int>(hn::Lanes(kReal)); }

using Real = hn::Vec<decltype(kReal)>;

// The bounds of an outline in the rows of a vector, px.
struct Reach {
  Real left, right;
};

template <typename Mask>
HWY_ATTR void widen_rows(Mask rows, Real left, Real right, Reach& reach) {
  reach.left = hn::IfThenElse(rows, hn::Min(reach.left, left), reach.left);
  reach.right = hn::IfThenElse(rows, hn::Max(reach.right, right), reach.right);
}

struct DiscRows {
  Real x, y, square;
  double first, last;  // rows that it covers

  HWY_ATTR DiscRows(const DiscTable& discs, size_t i)
      : x(hn::Set(kReal, discs.x[i])),
        y(hn::Set(kReal, discs.y[i])),
        square(hn::Set(kReal, discs.radius[i] * discs.radius[i])),
        first(discs.y[i] - discs.radius[i]),
        last(discs.y[i] + discs.radius[i]) {}

  HWY_ATTR void widen(Real row, Reach& reach) const {
    const Real dy = hn::Sub(row, y), left_over = hn::Sub(square, hn::Mul(dy, dy));
    const Real half = hn::Sqrt(hn::Max(left_over, hn::Zero(kReal)));
    widen_rows(hn::Ge(left_over, hn::Zero(kReal)), hn::Sub(x, half), hn::Add(x, half), reach);
  }
};

struct EdgeRows {
  Real first, last, x_at_0, slope;

  HWY_ATTR EdgeRows(const EdgeTable& edges, size_t i)
      : first(hn::Set(kReal, edges.first[i])),
        last(hn::Set(kReal, edges.last[i])),
        x_at_0(hn::Set(kReal, edges.x_at_0[i])),
        slope(hn::Set(kReal, edges.slope[i])) {}

  HWY_ATTR void widen(Real row, Reach& reach) const {
    const Real x = hn::Add(x_at_0, hn::Mul(slope, row));
    widen_rows(hn::And(hn::Ge(row, first), hn::Le(row, last)), x, x, reach);
  }
};

// The columns of the area as floating-point numbers.
struct Span {
  Real x0, width;
};

// Columns whose centres are between left and right.
HWY_ATTR void to_columns(const Reach& reach, const Span& span, int32_t* begins, int32_t* ends) {
  const Real zero = hn::Zero(kReal), one = hn::Set(kReal, 1.0);
  const auto clamped = [&](Real x) HWY_ATTR { return hn::Min(span.width, hn::Max(zero, x)); };
  const Real from = clamped(hn::Sub(reach.left, span.x0));
  const Real to = clamped(hn::Add(hn::Sub(reach.right, span.x0), one));
  const auto begin = hn::DemoteTo(kNarrow, hn::Ceil(from));
  const auto end = hn::DemoteTo(kNarrow, hn::Floor(to));
  const auto some = hn::Lt(begin, end);
  hn::StoreU(hn::IfThenElseZero(some, begin), kNarrow, begins);
  hn::StoreU(hn::IfThenElseZero(some, end), kNarrow, ends);
}

// Every part of the outline is in the convex hull, so that the outermost of those in a row are its
// bounds there.
HWY_ATTR void cover_rows(const Outlines& outlines, size_t i, const PixelRect& area, int block_row,
                         BlockRows rows, RowIntervals& out) {
  const DiscRows discs[2]{DiscRows(outlines.discs[0], i), DiscRows(outlines.discs[1], i)};
  const EdgeRows edges[2]{EdgeRows(outlines.edges[0], i), EdgeRows(outlines.edges[1], i)};
  const Span span{hn::Set(kReal, static_cast<double>(area.x0)),
                  hn::Set(kReal, static_cast<double>(area.width()))};
  const Reach nothing{hn::Set(kReal, std::numeric_limits<double>::max()),
                      hn::Set(kReal, std::numeric_limits<double>::lowest())};
  const int from = rows.from / real_lanes() * real_lanes();
  for (int k = from; k < rows.to; k += real_lanes()) {
    const double first = block_row + k, last = first + real_lanes() - 1;
    const Real row = hn::Iota(kReal, first);
    Reach reach = nothing;
    for (const EdgeRows& edge : edges) edge.widen(row, reach);
    for (const DiscRows& disc : discs)  // roots are expensive
      if (first <= disc.last && last >= disc.first) disc.widen(row, reach);
    to_columns(reach, span, out.begin + k, out.end + k);
  }
  // Rows that share a longer vector with them, or are below the area.
  const BlockRows whole = whole_vectors(rows);
  for (int32_t* const columns : {out.begin, out.end}) {
    std::fill(columns + whole.from, columns + from, 0);
    std::fill(columns + rows.to, columns + whole.to, 0);
  }
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

// The rest of a piece after `nearer` is removed. `nearer` begins after the piece begins, ends
// before the piece ends, both (then it is inside, and the part before it is the rest), or neither.
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

}  // namespace HWY_NAMESPACE
}  // namespace observation
}  // namespace walktrack
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace walktrack {
inline namespace observation {

namespace {

HWY_EXPORT(cover_rows);
HWY_EXPORT(hide_rows);

}  // namespace

void cover_rows(const Outlines& outlines, size_t i, const PixelRect& area, int block_row,
                BlockRows rows, RowIntervals& out) {
  HWY_DYNAMIC_DISPATCH(cover_rows)(outlines, i, area, block_row, rows, out);
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

}  // namespace observation
}  // namespace walktrack
#endif
