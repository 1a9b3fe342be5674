// The overlap of a figure's silhouette with the foreground near it, in one camera.
//
// The log-ratio of a pixel states how certain it is that the pixel shows a body, or does not. With
// these weights,
//   share = sum over both / (sum over either),
// where "both" are the pixels of the silhouette that look like a body, and "either" are these, the
// pixels of the silhouette that do not, and the pixels near the silhouette that do: the weighted
// Jaccard index (intersection over union) of silhouette and foreground. Pixels without evidence,
// such as those behind occluders, are not counted, nor are pixels near the silhouette that parts of
// the body may cover which the figure lacks.
#pragma once

#include <span>

#include "observation/silhouette/capsules.h"
#include "observation/silhouette/planes.h"

namespace walktrack {
inline namespace observation {

// Nats, except for `seen`; all zero if there is no evidence.
struct Overlap {
  double both = 0;     // in the silhouette, for a body
  double against = 0;  // in the silhouette, against a body
  double missed = 0;   // near the silhouette but outside, for a body, and not unmodelled
  double seen = 0;     // share of the silhouette's pixels that have evidence
  double known() const { return both + against + missed; }
  double share() const { return both / known(); }
};

// The neighbourhood is the silhouette's bounding box, widened to all sides by kNearMargin of its
// longer side. A pixel looks like a body if it looks like any part of it. By hand.
inline constexpr double kNearMargin = 0.15;

// `unmodelled`: silhouettes of what the subject has and the figure lacks.
Overlap overlap(const LogRatioPlanes& planes, const CapsuleList& figure,
                std::span<const CapsuleList> unmodelled = {});

}  // namespace observation
}  // namespace walktrack
