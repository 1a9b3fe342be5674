#include "tracker/start/keypoint_lead.h"

#include <algorithm>
#include <cmath>

#include "body/kinematics.h"
#include "camera/camera.h"
#include "observation/silhouette/overlap.h"

namespace walktrack {
inline namespace tracker {

bool must_lead(const KeypointConfig& keypoints) {
  return is_on(keypoints) && keypoints.lead == TermSetting::kOn;
}

bool keypoints_lead(const ObservationConfig& observation) {
  return observation.outline_share <= kLedOutlines;
}

bool may_lead(const TrackerScene& scene, const DetectedWalk& walk) {
  const KeypointConfig& keypoints = scene.observation.keypoints;
  const bool undecided = keypoints.lead == TermSetting::kAuto && !keypoints_lead(scene.observation);
  if (scene.cameras.size() != 1 || !is_on(keypoints) || !undecided) return false;
  const Eigen::Vector2d ray = walk.position - camera_centre(scene.cameras[0]).head<2>();
  return std::abs(ray.stableNormalized().dot(walk.velocity.stableNormalized())) > kAlongRay;
}

bool outlines_fit_badly(const TrackerScene& scene, const std::deque<SceneEvidence>& window,
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
  return points && sum.known() > 0 && sum.share() < kBadOverlap;
}

void let_keypoints_lead(ObservationConfig& observation) {
  observation.outline_share = kLedOutlines;
  observation.keypoints.weight = std::max(observation.keypoints.weight, kLeadingWeight);
}

}  // namespace tracker
}  // namespace walktrack
