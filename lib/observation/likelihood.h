// The log-likelihood of a pose in one camera, up to a constant of the frame: the sum of the terms
// that are enabled, each tempered by the number of independent pixels in a pixel.
//
//   log p(image | pose) = w [ sum over the visible silhouette of l(u) + weight * flow ] + constant
#pragma once

#include "observation/observer.h"
#include "observation/silhouette.h"

namespace walktrack {

// The two sums on their own. `before`: the same particle's capsules at the frame before.
double silhouette_log_likelihood(const CameraEvidence& evidence, const CapsuleList& now);
double flow_log_likelihood(const FlowConfig& config, const CameraEvidence& evidence,
                           const CapsuleList& now, const CapsuleList& before);

// `before`: the same particle's capsules at the frame before, or nullptr for no flow term.
double log_likelihood(const ObservationConfig& config, const CameraEvidence& evidence,
                      const CapsuleList& now, const CapsuleList* before);

}  // namespace walktrack
