#include "tracker/scene.h"

#include <algorithm>
#include <limits>

#include "body/kinematics.h"

namespace walktrack {

namespace {

std::vector<PosedPart> parts_of(const Body& body, const Pose& pose) {
  std::vector<PosedPart> parts;
  pose_parts(body, forward_kinematics(body, pose), parts);
  return parts;
}

}  // namespace

double log_likelihood(const TrackerScene& scene, const SceneEvidence& evidence,
                      const WalkerParticle& particle, bool with_motion) {
  const std::vector<PosedPart> now = parts_of(scene.model.body, particle.pose);
  const bool motion = with_motion && scene.observation.flow.enabled;
  const std::vector<PosedPart> before =
      motion ? parts_of(scene.model.body, particle.pose_before) : std::vector<PosedPart>{};
  double sum = 0;
  for (size_t c = 0; c < evidence.size(); ++c) {
    const CapsuleList capsules = project_parts(scene.cameras[c], now);
    if (motion) {
      const CapsuleList capsules_before = project_parts(scene.cameras[c], before);
      sum += log_likelihood(scene.observation, evidence[c], capsules, &capsules_before);
    } else {
      sum += log_likelihood(scene.observation, evidence[c], capsules, nullptr);
    }
  }
  return sum;
}

double place_score(const TrackerScene& scene, const SceneEvidence& evidence,
                   const Eigen::Vector2d& position, double heading) {
  double best = -std::numeric_limits<double>::infinity();
  for (const auto& figure : upright_figures(scene.model.body, position, heading)) {
    double sum = 0;
    for (size_t c = 0; c < evidence.size(); ++c)
      sum += log_likelihood(scene.observation, evidence[c], project_parts(scene.cameras[c], figure),
                            nullptr);
    best = std::max(best, sum);
  }
  return best;
}

}  // namespace walktrack
