// The terms that read pictures, summed by hand: the oracle of the fold in observation/terms.h, and
// what tests ask that have capsules rather than poses.
#pragma once

#include "observation/observer.h"
#include "observation/silhouette.h"

namespace walktrack {

// `before`: the same body's capsules at the frame before, or nullptr for no flow.
inline double log_likelihood(const ObservationConfig& config, const CameraEvidence& evidence,
                             const CapsuleList& now, const CapsuleList* before) {
  double sum = silhouette_log_ratio(evidence.planes, now);
  if (before) sum += config.flow.weight * flow_log_ratio(config.flow, evidence.flow, now, *before);
  return evidence.pixel_weight * sum;
}

}  // namespace walktrack
