#include "observation/silhouette.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace walktrack {

namespace {

using Eigen::Vector2d;

// A straight piece of an outline, x = x_at_0 + slope y for first <= y <= last.
struct Edge {
  double first = 1, last = 0;  // empty
  double x_at_0 = 0, slope = 0;
};

// The outline of a capsule: two discs and the two edges that touch both.
struct Outline {
  Vector2d centre[2];
  double radius[2];
  Edge edges[2];
  int first_row, last_row;  // rows whose pixel centres it may cover, inclusive
};

Edge edge_between(const Vector2d& a, const Vector2d& b) {
  const Vector2d& top = a.y() < b.y() ? a : b;
  const Vector2d& bottom = a.y() < b.y() ? b : a;
  const double height = bottom.y() - top.y();
  // A level edge adds nothing to a row that the discs do not hold already.
  if (height < 1e-9) return {};
  const double slope = (bottom.x() - top.x()) / height;
  return {top.y(), bottom.y(), top.x() - slope * top.y(), slope};
}

// With e the unit axis, D its length and s = (r_a - r_b) / D, the outward normals of the edges are
// s e +- sqrt(1 - s^2) e_perp (the same at both discs).
void add_edges(const Disc& a, const Disc& b, Outline& out) {
  const Vector2d axis = b.centre - a.centre;
  const double length = axis.norm();
  if (length <= std::abs(a.radius - b.radius)) return;
  const Vector2d e = axis / length, perpendicular(-e.y(), e.x());
  const double s = (a.radius - b.radius) / length, c = std::sqrt(1 - s * s);
  for (const int side : {0, 1}) {
    const Vector2d normal = s * e + (side == 0 ? c : -c) * perpendicular;
    out.edges[side] = edge_between(a.centre + a.radius * normal, b.centre + b.radius * normal);
  }
}

// Rows and columns are clamped before they become integers: a part close to the camera may be
// projected millions of pixels away.
int clamped(double value, int low, int high) {
  return static_cast<int>(std::clamp(value, static_cast<double>(low), static_cast<double>(high)));
}

Outline outline(const Capsule& capsule, const PixelRect& area) {
  const Disc &a = capsule.lower, &b = capsule.upper;
  Outline out{{a.centre, b.centre}, {a.radius, b.radius}, {}, 0, 0};
  const double top = std::min(a.centre.y() - a.radius, b.centre.y() - b.radius);
  const double bottom = std::max(a.centre.y() + a.radius, b.centre.y() + b.radius);
  out.first_row = clamped(std::ceil(top), area.y0, area.y1);
  out.last_row = clamped(std::floor(bottom), area.y0 - 1, area.y1 - 1);
  if (out.first_row <= out.last_row) add_edges(a, b, out);
  return out;
}

// Rows are worked on in blocks, so that all that is known about them has a fixed size and stays in
// the nearest cache.
constexpr int kBlockRows = 64;

struct Interval {
  int begin, end;  // columns counted from the area's left, end excluded
};

// Columns of consecutive rows whose centres lie inside one outline.
struct Columns {
  int first_row, count;
  double left[kBlockRows], right[kBlockRows];  // px, while they are found
  Interval at[kBlockRows];
};

// The rows first..last of a piece of the outline that are among the block's, counted from its
// first.
struct RowRange {
  int begin, end;
};

RowRange rows_between(double first, double last, const Columns& columns) {
  const double begin = std::ceil(first) - columns.first_row;
  const double end = std::floor(last) - columns.first_row + 1;
  return {clamped(begin, 0, columns.count), clamped(end, 0, columns.count)};
}

void widen_by_disc(const Vector2d& centre, double radius, Columns& columns) {
  const RowRange rows = rows_between(centre.y() - radius, centre.y() + radius, columns);
  const double x = centre.x(), square = radius * radius, top = columns.first_row - centre.y();
  for (int k = rows.begin; k < rows.end; ++k) {
    const double dy = top + k;
    const double half = std::sqrt(std::max(0.0, square - dy * dy));
    columns.left[k] = std::min(columns.left[k], x - half);
    columns.right[k] = std::max(columns.right[k], x + half);
  }
}

void widen_by_edge(const Edge& edge, Columns& columns) {
  const RowRange rows = rows_between(edge.first, edge.last, columns);
  const double x0 = edge.x_at_0 + edge.slope * columns.first_row;
  for (int k = rows.begin; k < rows.end; ++k) {
    const double x = x0 + edge.slope * k;
    columns.left[k] = std::min(columns.left[k], x);
    columns.right[k] = std::max(columns.right[k], x);
  }
}

// Every piece of the outline lies in the convex hull, so the outermost of those that meet a row
// bound it there.
void find_columns(const Outline& shape, const PixelRect& area, int first_row, int end_row,
                  Columns& columns) {
  columns.first_row = first_row;
  columns.count = end_row - first_row;
  std::fill_n(columns.left, columns.count, std::numeric_limits<double>::max());
  std::fill_n(columns.right, columns.count, std::numeric_limits<double>::lowest());
  for (const int i : {0, 1}) widen_by_disc(shape.centre[i], shape.radius[i], columns);
  for (const Edge& edge : shape.edges) widen_by_edge(edge, columns);
  const double x0 = area.x0, width = area.width();
  for (int k = 0; k < columns.count; ++k) {
    const double from = std::min(width, std::max(0.0, columns.left[k] - x0));
    const double to = std::min(width, std::max(0.0, columns.right[k] - x0 + 1));
    const int truncated = static_cast<int>(from);
    columns.at[k] = {truncated + (truncated < from ? 1 : 0), static_cast<int>(to)};
  }
}

// The columns of one row that are taken: disjoint intervals from left to right.
struct Cover {
  int count = 0;
  Interval taken[kMaxCapsules];
};

// Adds `fresh` to the cover and calls visit(begin, end) for each stretch of it that was free.
template <typename Visit>
void paint(Cover& cover, Interval fresh, Visit&& visit) {
  Interval* const taken = cover.taken;
  int from = 0;
  while (from < cover.count && taken[from].end < fresh.begin) ++from;
  int to = from, free_from = fresh.begin;
  Interval merged = fresh;
  for (; to < cover.count && taken[to].begin <= fresh.end; ++to) {
    if (free_from < taken[to].begin) visit(free_from, taken[to].begin);
    free_from = std::max(free_from, taken[to].end);
    merged.begin = std::min(merged.begin, taken[to].begin);
  }
  if (free_from < fresh.end) visit(free_from, fresh.end);
  merged.end = std::max(fresh.end, free_from);
  if (to == from) {
    std::copy_backward(taken + from, taken + cover.count, taken + cover.count + 1);
    ++cover.count;
  } else {
    std::copy(taken + to, taken + cover.count, taken + from + 1);
    cover.count -= to - from - 1;
  }
  taken[from] = merged;
}

// Calls visit(row, begin, end, capsule) for every visible run, columns counted from area.x0.
template <typename Visit>
void paint_all(const PixelRect& area, const CapsuleList& capsules, Visit&& visit) {
  std::array<Outline, kMaxCapsules> shapes;
  int first = area.y1, last = area.y0 - 1;
  for (size_t i = 0; i < capsules.size(); ++i) {
    shapes[i] = outline(capsules[i], area);
    if (shapes[i].first_row > shapes[i].last_row) continue;
    first = std::min(first, shapes[i].first_row);
    last = std::max(last, shapes[i].last_row);
  }
  std::array<Cover, kBlockRows> covers;
  Columns columns;
  for (int block = first; block <= last; block += kBlockRows) {
    for (Cover& cover : covers) cover.count = 0;
    for (size_t i = 0; i < capsules.size(); ++i) {
      const int begin = std::max(shapes[i].first_row, block);
      const int end = std::min(shapes[i].last_row + 1, block + kBlockRows);
      if (begin >= end) continue;
      find_columns(shapes[i], area, begin, end, columns);
      for (int row = begin; row < end; ++row) {
        const Interval& fresh = columns.at[row - begin];
        if (fresh.begin >= fresh.end) continue;
        paint(covers[static_cast<size_t>(row - block)], fresh,
              [&](int x0, int x1) { visit(row, x0, x1, i); });
      }
    }
  }
}

}  // namespace

double silhouette_log_ratio(const LogRatioPlanes& planes, const CapsuleList& capsules) {
  if (planes.count == 0 || planes.area.empty()) return 0;
  std::array<int, kMaxCapsules> plane;
  for (size_t i = 0; i < capsules.size(); ++i)
    plane[i] = planes.plane_of[static_cast<size_t>(capsules[i].appearance)];
  int64_t sum = 0;
  paint_all(planes.area, capsules, [&](int row, int x0, int x1, size_t capsule) {
    const int32_t* prefix = planes.row(plane[capsule], row).data();
    sum += prefix[x1] - prefix[x0];
  });
  return static_cast<double>(sum) / LogRatioPlanes::kNat;
}

std::vector<VisibleRun> visible_runs(const PixelRect& area, const CapsuleList& capsules) {
  std::vector<VisibleRun> runs;
  if (area.empty()) return runs;
  paint_all(area, capsules, [&](int row, int x0, int x1, size_t capsule) {
    runs.push_back({row, area.x0 + x0, area.x0 + x1, static_cast<int>(capsule)});
  });
  return runs;
}

}  // namespace walktrack
