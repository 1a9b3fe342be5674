// The terms that read pictures, summed by hand: the oracle of the fold in observation/terms.h, and
// what tests ask that have capsules rather than poses. These may ask flow about the whole body.
#pragma once

#include "observation/observer.h"
#include "observation/silhouette/silhouette.h"

namespace walktrack {

// `before`: the same body's capsules at the frame before, or nullptr for no flow.
inline double log_likelihood(const ObservationConfig& config, const CameraEvidence& evidence,
                             const CapsuleList& now, const CapsuleList* before) {
  double sum = silhouette_log_ratio(evidence.planes, now);
  if (before) sum += config.flow.weight * flow_log_ratio(config.flow, evidence.flow, now, *before);
  return evidence.pixel_weight * sum;
}

// The same as particles are weighed: flow is asked about legs and feet.
inline double particle_log_likelihood(const ObservationConfig& config,
                                      const CameraEvidence& evidence, const CapsuleList& now,
                                      const CapsuleList* before) {
  const auto legs = [](const CapsuleList& capsules) {
    CapsuleList out;
    for (const Capsule& each : capsules)
      if (each.appearance == Appearance::kLegs || each.appearance == Appearance::kFeet)
        out.insert(each);
    return out;
  };
  const double silhouettes = log_likelihood(config, evidence, now, nullptr);
  if (!before) return silhouettes;
  return silhouettes + evidence.pixel_weight * config.flow.weight *
                           flow_log_ratio(config.flow, evidence.flow, legs(now), legs(*before));
}

}  // namespace walktrack
