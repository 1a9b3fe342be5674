#include "observation/likelihood.h"

namespace walktrack {

double log_likelihood(const ObservationConfig& config, const CameraEvidence& evidence,
                      const CapsuleList& now, const CapsuleList* before) {
  double sum = silhouette_log_ratio(evidence.planes, now);
  if (before) sum += config.flow.weight * flow_log_ratio(config.flow, evidence.flow, now, *before);
  return evidence.pixel_weight * sum;
}

}  // namespace walktrack
