#include "tracker/frame_likelihood.h"

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
                     [](const CameraEvidence& camera) { return !camera.flow.samples.empty(); });
}

}  // namespace

FrameLikelihood::FrameLikelihood(const TrackerScene& scene, const SceneEvidence& evidence,
                                 bool with_motion)
    : scene_(scene),
      evidence_(evidence),
      motion_(with_motion && any_flow(evidence)),
      silhouette_stages_(std::clamp(static_cast<int>(evidence.size()), 1, kSilhouetteStages)) {}

FrameLikelihood::Account::Account(const FrameLikelihood& frame, const WalkerParticle& particle)
    : frame_(frame),
      particle_(particle),
      parts_(parts_of(frame.scene_.model.body, particle.pose)) {}

double FrameLikelihood::Account::operator()(int stage) const {
  if (stage == frame_.silhouette_stages_) return flow();
  const double prior = stage == 0 ? log_uprightness(frame_.scene_.model, particle_.pose) : 0;
  return prior + silhouettes(stage);
}

double FrameLikelihood::Account::silhouettes(int stage) const {
  double sum = 0;
  const auto step = static_cast<size_t>(frame_.silhouette_stages_);
  for (size_t c = static_cast<size_t>(stage); c < frame_.evidence_.size(); c += step)
    sum += silhouette_log_likelihood(frame_.evidence_[c],
                                     project_parts(frame_.scene_.cameras[c], parts_));
  return sum;
}

double FrameLikelihood::Account::flow() const {
  const PosedParts before = parts_of(frame_.scene_.model.body, particle_.pose_before);
  double sum = 0;
  for (size_t c = 0; c < frame_.evidence_.size(); ++c) {
    const CameraEvidence& evidence = frame_.evidence_[c];
    if (evidence.flow.samples.empty()) continue;
    const Camera& camera = frame_.scene_.cameras[c];
    sum += flow_log_likelihood(frame_.scene_.observation.flow, evidence,
                               project_parts(camera, parts_), project_parts(camera, before));
  }
  return sum;
}

}  // namespace walktrack
