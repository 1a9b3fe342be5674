#include "tracker/frame_likelihood.h"

#include <algorithm>

namespace walktrack {

namespace {

PosedParts parts_of(const Body& body, const Pose& pose) {
  return pose_parts(body, forward_kinematics(body, pose));
}

// Walking people keep their hips up: below .82 of the leg's length the pose becomes improbable,
// 1 % of it counting as one standard deviation (the prior's longest steps lower the hip to .83).
double log_uprightness(const BodyModel& model, const Pose& pose) {
  const double below = 0.82 - pose.root.z() / leg_length(model.body.lengths);
  return below > 0 ? -0.5 * (below / 0.01) * (below / 0.01) : 0;
}

bool any_flow(const SceneEvidence& evidence) {
  return std::any_of(evidence.begin(), evidence.end(),
                     [](const CameraEvidence& camera) { return !camera.flow.pixels.empty(); });
}

}  // namespace

FrameLikelihood::FrameLikelihood(const TrackerScene& scene, const SceneEvidence& evidence,
                                 bool with_motion)
    : scene_(scene), evidence_(evidence), motion_(with_motion && any_flow(evidence)) {}

FrameLikelihood::Account::Account(const FrameLikelihood& frame, const WalkerParticle& particle)
    : frame_(frame),
      particle_(particle),
      parts_(parts_of(frame.scene_.model.body, particle.pose)) {}

double FrameLikelihood::Account::operator()(int stage) const {
  if (stage > 0) return all_else();
  const double prior = log_uprightness(frame_.scene_.model, particle_.pose);
  return frame_.evidence_.empty() ? prior : prior + silhouettes(0);
}

double FrameLikelihood::Account::all_else() const {
  double sum = 0;
  for (size_t c = 1; c < frame_.evidence_.size(); ++c) sum += silhouettes(c);
  if (!frame_.motion_) return sum;
  const PosedParts before = parts_of(frame_.scene_.model.body, particle_.pose_before);
  for (size_t c = 0; c < frame_.evidence_.size(); ++c) sum += flow(c, before);
  return sum;
}

double FrameLikelihood::Account::silhouettes(size_t camera) const {
  return silhouette_log_likelihood(frame_.evidence_[camera],
                                   project_parts(frame_.scene_.cameras[camera], parts_));
}

double FrameLikelihood::Account::flow(size_t camera, const PosedParts& before) const {
  const CameraEvidence& evidence = frame_.evidence_[camera];
  if (evidence.flow.pixels.empty()) return 0;
  const Camera& view = frame_.scene_.cameras[camera];
  return flow_log_likelihood(frame_.scene_.observation.flow, evidence, project_parts(view, parts_),
                             project_parts(view, before));
}

}  // namespace walktrack
