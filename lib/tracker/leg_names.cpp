#include "tracker/leg_names.h"

#include <algorithm>

#include "body/kinematics.h"
#include "observation/leg_order.h"

namespace walktrack {

namespace {

// Pixels of successive frames err together: so many nats of theirs count as one. Windows of made
// walks whose legs bear the right names have -4 to +18 nats.
constexpr double kNatsForOne = 3;

CapsuleList seen_from(const TrackerScene& scene, const Pose& pose) {
  const Body& body = scene.model.body;
  return project_parts(scene.cameras[0], pose_parts(body, forward_kinematics(body, pose)));
}

double frame_log_ratio(const TrackerScene& scene, const CameraEvidence& before,
                       const CameraEvidence& now, const Pose& pose_before, const Pose& pose) {
  if (before.picture.pixels.empty() || now.picture.pixels.empty()) return 0;
  const Body& body = scene.model.body;
  const CapsuleList legs = seen_from(scene, pose);
  const PixelRect area = leg_overlap(body.parts, legs);
  if (area.empty()) return 0;
  const FlowConfig& config = scene.observation.flow;
  FlowField flow;
  pair_frames(config, before.picture, now.picture, area, flow);
  const double at_walker =
      person_region(scene.cameras[0], pose.root.head<2>(), body.subject.height, 0).metres_per_px;
  return independent_share(scene.observation, at_walker) *
         leg_order_log_ratio(config, body.parts, flow,
                             {seen_from(scene, pose_before), before.planes}, {legs, now.planes});
}

}  // namespace

double legs_log_odds(const TrackerScene& scene, const std::deque<SceneEvidence>& window,
                     std::span<const FrameRecord> records) {
  double sum = 0;
  for (size_t i = 1; i < std::min(window.size(), records.size()); ++i) {
    if (records[i - 1].tracked && records[i].tracked)
      sum += frame_log_ratio(scene, window[i - 1][0], window[i][0], records[i - 1].estimate.pose,
                             records[i].estimate.pose);
  }
  return sum / kNatsForOne;
}

}  // namespace walktrack
