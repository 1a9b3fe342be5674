// The outline of a capsule in the image, prepared for evaluation row by row.
#pragma once

#include "observation/silhouette/capsules.h"
#include "observation/silhouette/planes.h"

namespace walktrack {
inline namespace observation {

// A straight part of an outline, x = x_at_0 + slope y for first <= y <= last.
struct Edge {
  double first = 1, last = 0;  // empty
  double x_at_0 = 0, slope = 0;
};

// The outline of a capsule: two discs and the two edges that touch both.
struct Outline {
  Disc discs[2];
  Edge edges[2];
  int first_row, end_row;  // rows of the area whose pixel centres it may cover, without end_row
};

Outline outline_of(const Capsule& capsule, const PixelRect& area);

}  // namespace observation
}  // namespace walktrack
