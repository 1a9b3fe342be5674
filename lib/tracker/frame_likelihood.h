// What the images of one frame say about particles, in stages that are asked one after the other: a
// proposal that the first camera speaks against need not be shown to the others
// (filter/particle_filter.h).
#pragma once

#include "body/kinematics.h"
#include "filter/particle_filter.h"
#include "tracker/scene.h"

namespace walktrack {

class FrameLikelihood {
 public:
  // `with_motion`: particles have a frame before this one, so that flow says something.
  FrameLikelihood(const TrackerScene& scene, const SceneEvidence& evidence, bool with_motion);

  // Silhouettes of the first camera, then all else: the other cameras' silhouettes, and flow where
  // any was measured. More stages would save little more, and every stage that can reject a move
  // costs some that all of them together would accept.
  int stages() const { return evidence_.size() > 1 || motion_ ? kMaxStages : 1; }

  class Account {
   public:
    Account(const FrameLikelihood& frame, const WalkerParticle& particle);
    // Log-likelihood of that stage's images, nats; the sum over all stages is the particle's.
    double operator()(int stage) const;

   private:
    double silhouettes(size_t camera) const;
    double flow(size_t camera, const PosedParts& before) const;
    double all_else() const;

    const FrameLikelihood& frame_;
    const WalkerParticle& particle_;
    PosedParts parts_;
  };

  Account operator()(const WalkerParticle& particle) const { return {*this, particle}; }

 private:
  const TrackerScene& scene_;
  const SceneEvidence& evidence_;
  bool motion_;
};

}  // namespace walktrack
