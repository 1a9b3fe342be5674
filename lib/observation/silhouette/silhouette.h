// The exact sum of log-ratios over the visible silhouette of a body.
//
// A pixel belongs to a capsule if its centre is inside or on the outline. It counts once, with the
// plane of the nearest capsule that covers it. A capsule covers one interval of an image row, so
// that the sum over a row takes a few differences of prefix sums: the cost grows with the height of
// the figure in pixels, not with its area.
#pragma once

#include "observation/silhouette/capsules.h"
#include "observation/silhouette/planes.h"

namespace walktrack {
inline namespace observation {

// Sum of l over the visible silhouette, nats (neither tempered nor weighted); 0 without planes.
double silhouette_log_ratio(const LogRatioPlanes& planes, const CapsuleList& capsules);

// A run of pixels x0 <= x < x1 of row y in which one capsule is visible.
struct VisibleRun {
  int y, x0, x1;
  int capsule;  // index into the list
};

// All runs of the visible silhouette inside `area`, row by row in blocks, nearest capsule first.
std::vector<VisibleRun> visible_runs(const PixelRect& area, const CapsuleList& capsules);

}  // namespace observation
}  // namespace walktrack
