// The motion model `kneed`: the kneed walker with its springs (tracker/motion/models/walk_on.h)
// determines trunk and legs, residual angles are added to its own, and particles that have missed a
// strike make phase jumps (tracker/moves/phase_jump.h).
#pragma once

#include "gait/prior/gait_prior.h"
#include "tracker/motion/motion_model.h"
#include "tracker/motion/step_library.h"

namespace walktrack {
inline namespace tracker {

// The walker at a share of a step of a gait of the prior, on the gait's slope.
KneedState state_in_gait(const BodyModel& model, const PriorGait& gait, double phase);

// A person in a gait of the prior, at a share of the step of the supporting foot: the root above
// the origin, heading 0, everything that the walker does not drive at rest.
Pose pose_in_gait(const BodyModel& model, const PriorGait& gait, Side stance, double phase);

class KneedMotion : public MotionModel {
 public:
  KneedMotion(const BodyModel& model, const GaitPrior& prior) : steps_(model, prior) {}
  MarkovConstants constants(const MotionConfig& config, ResidualAngle residual) const override;
  void initialise(const MotionContext& context, std::span<const double> phases,
                  std::span<WalkerParticle> particles) const override;
  bool jump_phase(const MotionContext& context, WalkerParticle& particle, Rng& rng) const override;
  void predict(const MotionContext& context, std::span<WalkerParticle> particles,
               std::span<Rng> rngs, std::span<Outcome> outcomes) const override;
  bool linearise_noise(const MotionContext& context, WalkerParticle& particle) const override;
  void apply_noise(const MotionContext& context, WalkerParticle& particle) const override;
  std::span<const NoiseGroup> noise_groups(Path path) const override;

 private:
  StepLibrary steps_;  // steps for phase jumps
};

}  // namespace tracker
}  // namespace walktrack
