#include "observation/likelihood.h"

namespace walktrack {

double silhouette_log_likelihood(const CameraEvidence& evidence, const CapsuleList& now) {
  return evidence.pixel_weight * silhouette_log_ratio(evidence.planes, now);
}

double flow_log_likelihood(const FlowConfig& config, const CameraEvidence& evidence,
                           const CapsuleList& now, const CapsuleList& before) {
  return evidence.pixel_weight * config.weight * flow_log_ratio(config, evidence.flow, now, before);
}

double log_likelihood(const ObservationConfig& config, const CameraEvidence& evidence,
                      const CapsuleList& now, const CapsuleList* before) {
  double sum = silhouette_log_likelihood(evidence, now);
  if (before) sum += flow_log_likelihood(config.flow, evidence, now, *before);
  return sum;
}

}  // namespace walktrack
