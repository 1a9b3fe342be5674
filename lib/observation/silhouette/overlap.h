// How far a figure's silhouette and the foreground near it cover each other, in one camera.
//
// A pixel's log-ratio says how surely it shows a body, or surely none. Weighted by that,
//   share = sum over both / (sum over either),
// "both" being pixels of the silhouette that speak for a body, "either" besides them those of the
// silhouette that speak against one and those near it, outside, that speak for one: the weighted
// Jaccard index (intersection over union) of silhouette and foreground. Pixels of which nothing is
// known, as behind occluders, count for nothing.
#pragma once

#include "observation/silhouette/capsules.h"
#include "observation/silhouette/planes.h"

namespace walktrack {
inline namespace observation {

// Nats; all zero where nothing is known.
struct Overlap {
  double both = 0;     // in the silhouette, for a body
  double against = 0;  // in the silhouette, against a body
  double missed = 0;   // near the silhouette but outside, for a body
  double known() const { return both + against + missed; }
  double share() const { return both / known(); }
};

// Near is what lies in the silhouette's bounding box, widened to all sides by kNearMargin of the
// longer of its sides. A pixel speaks for a body if any of its parts may look so. By hand.
inline constexpr double kNearMargin = 0.15;

Overlap overlap(const LogRatioPlanes& planes, const CapsuleList& figure);

}  // namespace observation
}  // namespace walktrack
