#include "tracker/start/keypoint_lead.h"

#include <algorithm>

#include "body/kinematics.h"
#include "observation/silhouette/overlap.h"

namespace walktrack {
inline namespace tracker {

bool must_lead(const KeypointConfig& keypoints) {
  return is_on(keypoints) && keypoints.lead == TermSetting::kOn;
}

bool keypoints_lead(const ObservationConfig& observation) {
  return observation.outline_share <= kLedOutlines;
}

bool may_lead(const TrackerScene& scene) {
  const KeypointConfig& keypoints = scene.observation.keypoints;
  const bool undecided = keypoints.lead == TermSetting::kAuto && !keypoints_lead(scene.observation);
  return scene.cameras.size() == 1 && is_on(keypoints) && undecided;
}

bool figure_is_too_thin(const TrackerScene& scene, const std::deque<SceneEvidence>& window,
                        std::span<const FrameRecord> records) {
  const Body& body = scene.model.body;
  Overlap sum;
  bool points = false;
  for (size_t i = 0; i < std::min(records.size(), window.size()); ++i) {
    const CameraEvidence& evidence = window[i].front();
    points = points || KeypointTerm::says(evidence);
    if (!records[i].tracked) continue;
    const Skeleton skeleton = forward_kinematics(body, records[i].estimate.pose);
    const Overlap found =
        overlap(evidence.planes, project_parts(scene.cameras[0], pose_parts(body, skeleton)));
    sum.both += found.both;
    sum.against += found.against;
    sum.missed += found.missed;
  }
  return points && sum.missed > kUncovered * sum.known();
}

void let_keypoints_lead(ObservationConfig& observation) {
  observation.outline_share = kLedOutlines;
  observation.keypoints.weight = std::max(observation.keypoints.weight, kLeadingWeight);
}

}  // namespace tracker
}  // namespace walktrack
