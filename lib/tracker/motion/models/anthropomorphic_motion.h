// The motion model `anthropomorphic`: McGeer's and Kuo's walker of two straight legs
// (walker/straight/straight_walker.h) with the prior over its gaits determines the lines from hips
// to ankles and, above the supporting foot, the root. What it lacks, knees and a trunk, follows the
// Markov processes of tracker/motion/models/markov_motion.h; pelvis, hips' abduction and rotation,
// and arms follow those of the kneed model. One of the trackers before the kneed walker's was
// similar.
//
// The walker's state is stored in a kneed walker's, with the trunk upright and the knees straight.
#pragma once

#include "gait/prior/straight_prior.h"
#include "tracker/motion/motion_model.h"

namespace walktrack {
inline namespace tracker {

class AnthropomorphicMotion : public MotionModel {
 public:
  explicit AnthropomorphicMotion(const BodyModel& model);
  MarkovConstants constants(const MotionConfig& config, ResidualAngle residual) const override;
  void initialise(const MotionContext& context, std::span<const double> phases,
                  std::span<WalkerParticle> particles) const override;
  void predict(const MotionContext& context, std::span<WalkerParticle> particles,
               std::span<Rng> rngs, std::span<Outcome> outcomes) const override;
  bool linearise_noise(const MotionContext& context, WalkerParticle& particle) const override;
  void apply_noise(const MotionContext& context, WalkerParticle& particle) const override;
  std::span<const NoiseGroup> noise_groups(Path path) const override;

 private:
  Outcome walk(const MotionContext& context, WalkerParticle& particle, Rng& rng) const;
  void change_support(const MotionContext& context, WalkerParticle& particle, Rng& rng) const;
  void catch_step(const BodyModel& model, WalkerParticle& particle) const;
  StraightGait aimed_gait(const BodyModel& model, const WalkerParticle& particle) const;
  StraightState state_in_gait(const BodyModel& model, const StraightGait& gait, double phase) const;
  StraightModel model_on(const BodyModel& model, double gravity_x) const;

  StraightLeggedParameters parameters_;
  StraightModel level_;
  StraightPrior prior_;
};

}  // namespace tracker
}  // namespace walktrack
