#include "tracker/frame_likelihood.h"

#include <limits>
#include <optional>

#include <Eigen/Geometry>

#include "tracker/walk_prior.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Walking people keep their hips up: below .82 of the leg's length the pose becomes improbable,
// 1 % of it counting as one standard deviation (the prior's longest steps lower the hip to .83).
double log_uprightness(const BodyModel& model, const Pose& pose) {
  const double below = 0.82 - pose.root.z() / leg_length(model.body.lengths);
  return below > 0 ? -0.5 * (below / 0.01) * (below / 0.01) : 0;
}

// Knees and ankles beside the pelvis as those of people who walk in the particle's direction.
// Several cameras see where they are.
double log_legs_aside(const TrackerScene& scene, const WalkerParticle& particle,
                      const PosedBody& now) {
  if (scene.cameras.size() != 1) return 0;
  const WalkingDirection ahead =
      walking_direction(Eigen::Rotation2Dd(particle.pose.heading) * particle.way);
  if (!ahead) return 0;
  const LegsAside off = legs_aside(now.skeleton.joints, scene.model.body.subject.height, *ahead);
  return -0.5 * scene.dt / kLegsAsideTime * off.squaredNorm();
}

}  // namespace

FrameLikelihood::FrameLikelihood(const TrackerScene& scene, const SceneEvidence& evidence,
                                 bool with_motion)
    : scene_(scene),
      evidence_(evidence),
      with_motion_(with_motion),
      late_(any([]<typename Term>() { return Term::kStage == TermStage::kLate; })),
      before_(any([]<typename Term>() { return kWeighsParticles<Term> && Term::kAsksBefore; })) {}

FrameLikelihood::Account::Account(const FrameLikelihood& frame, const WalkerParticle& particle)
    : frame_(frame), particle_(particle), now_(frame.scene_.model.body, particle.pose) {}

double FrameLikelihood::Account::operator()(int stage) const {
  return stage > 0 ? all_else() : first_camera();
}

double FrameLikelihood::Account::first_camera() const {
  double sum = log_uprightness(frame_.scene_.model, particle_.pose) +
               log_legs_aside(frame_.scene_, particle_, now_);
  if (frame_.evidence_.empty()) return sum;
  Terms::each([&]<typename Term>() {
    if constexpr (Term::kStage == TermStage::kEarly) sum += of_camera<Term>(0, nullptr);
  });
  return sum;
}

double FrameLikelihood::Account::all_else() const {
  std::optional<PosedBody> before;
  if (frame_.before_) before.emplace(frame_.scene_.model.body, particle_.pose_before);
  double sum = 0;
  Terms::each([&]<typename Term>() {
    if constexpr (kWeighsParticles<Term>) {
      constexpr size_t kFirst = Term::kStage == TermStage::kEarly ? 1 : 0;
      for (size_t c = kFirst; c < frame_.evidence_.size(); ++c)
        sum += of_camera<Term>(c, before ? &*before : nullptr);
    }
  });
  return sum;
}

std::vector<TermValues> FrameLikelihood::by_term(const WalkerParticle& particle) const {
  const Body& body = scene_.model.body;
  const PosedBody now(body, particle.pose), before(body, particle.pose_before);
  std::vector<TermValues> out(evidence_.size());
  for (size_t c = 0; c < out.size(); ++c) {
    size_t term = 0;
    Terms::each([&]<typename Term>() {
      double& value = out[c][term++];
      value = std::numeric_limits<double>::quiet_NaN();
      if constexpr (kWeighsParticles<Term>)
        if (asks<Term>(evidence_[c]))
          value = Term::log_likelihood(scene_.observation, evidence_[c], scene_.cameras[c], now,
                                       &before);
    });
  }
  return out;
}

}  // namespace tracker
}  // namespace walktrack
