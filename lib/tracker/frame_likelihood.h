// What the images of one frame say about particles, in stages that are asked one after the other: a
// proposal that the first camera speaks against need not be shown to the others
// (filter/particle_filter.h).
#pragma once

#include <algorithm>

#include "body/kinematics.h"
#include "tracker/scene.h"

namespace walktrack {

class FrameLikelihood {
 public:
  static constexpr int kMaxStages = 4;

  // `with_motion`: particles have a frame before this one, so that flow says something.
  FrameLikelihood(const TrackerScene& scene, const SceneEvidence& evidence, bool with_motion);

  // Silhouettes of the cameras, one camera a stage while there are stages, then flow in all of them
  // if anything was measured.
  int stages() const { return silhouette_stages_ + (motion_ ? 1 : 0); }

  class Account {
   public:
    Account(const FrameLikelihood& frame, const WalkerParticle& particle);
    // Log-likelihood of that stage's images, nats; the sum over all stages is the particle's.
    double operator()(int stage) const;

   private:
    double silhouettes(int stage) const;
    double flow() const;

    const FrameLikelihood& frame_;
    const WalkerParticle& particle_;
    PosedParts parts_;
  };

  Account operator()(const WalkerParticle& particle) const { return {*this, particle}; }

 private:
  static constexpr int kSilhouetteStages = kMaxStages - 1;

  const TrackerScene& scene_;
  const SceneEvidence& evidence_;
  bool motion_;
  int silhouette_stages_;
};

}  // namespace walktrack
