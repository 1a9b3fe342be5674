// The likelihood of particles given the images of one frame, in stages that are computed one after
// the other: a proposal that the first camera rejects need not be compared with the images of the
// others (filter/particle_filter.h). The terms and their stages are those of observation/terms.h.
#pragma once

#include "filter/particle_filter.h"
#include "observation/terms.h"
#include "tracker/tracker_scene.h"

namespace walktrack {
inline namespace tracker {

class FrameLikelihood {
 public:
  // `with_motion`: particles have a frame before this one, so that the flow term can be computed.
  FrameLikelihood(const TrackerScene& scene, const SceneEvidence& evidence, bool with_motion);

  // The first stage has the early terms of the first camera, the second stage all other terms:
  // those of the other cameras, and the late terms. More stages would save little more time, and
  // every stage that can reject a move rejects some that all terms together would accept.
  int stages() const { return evidence_.size() > 1 || late_ ? kMaxStages : 1; }

  class Account {
   public:
    Account(const FrameLikelihood& frame, const WalkerParticle& particle);
    // Log-likelihood of that stage, nats; the sum over all stages is the log-likelihood of the
    // particle.
    double operator()(int stage) const;

   private:
    double first_camera() const;
    double all_else() const;
    template <typename Term>
    double of_camera(size_t c, const PosedBody* before) const {
      const CameraEvidence& evidence = frame_.evidence_[c];
      if (!frame_.asks<Term>(evidence)) return 0;
      const TrackerScene& scene = frame_.scene_;
      return Term::log_likelihood(scene.observation, evidence, scene.cameras[c], now_, before);
    }

    const FrameLikelihood& frame_;
    const WalkerParticle& particle_;
    PosedBody now_;
  };

  Account operator()(const WalkerParticle& particle) const { return {*this, particle}; }

  // The log-likelihood of a particle, by term and camera.
  std::vector<TermValues> by_term(const WalkerParticle& particle) const;

 private:
  template <typename Term>
  bool asks(const CameraEvidence& camera) const {
    return (with_motion_ || !Term::kAsksBefore) && Term::says(camera);
  }
  // Whether any term that is `wanted` is used for any camera.
  template <typename F>
  bool any(const F& wanted) const {
    bool found = false;
    Terms::each([&]<typename Term>() {
      if (wanted.template operator()<Term>())
        for (const CameraEvidence& camera : evidence_) found = found || asks<Term>(camera);
    });
    return found;
  }

  const TrackerScene& scene_;
  const SceneEvidence& evidence_;
  bool with_motion_;
  bool late_;    // whether there is any late term
  bool before_;  // whether any term compares with the frame before
};

}  // namespace tracker
}  // namespace walktrack
