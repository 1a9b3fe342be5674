// The terms that use images, summed by hand: the oracle of the sum in observation/terms.h, and a
// function for tests with capsules instead of poses, which may use flow for the whole body.
#pragma once

#include "observation/observer.h"
#include "observation/silhouette/silhouette.h"

namespace walktrack {

// `before`: the same body's capsules in the previous frame, or nullptr without flow.
inline double log_likelihood(const ObservationConfig& config, const CameraEvidence& evidence,
                             const CapsuleList& now, const CapsuleList* before) {
  double sum = silhouette_log_ratio(evidence.planes, now);
  if (before) sum += config.flow.weight * flow_log_ratio(config.flow, evidence.flow, now, *before);
  return evidence.pixel_weight * sum;
}

// The same as for particles: flow is used for legs and feet only.
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
