// The motion model `markov`: no walker and no ground. Root, trunk and every joint angle follow
// Markov processes of their own, which know how people's angles are spread and how fast they
// change, but not that feet stand and that legs take turns.
//
// Processes of the angles and of the root's height are the damped ones of
// tracker/motion/propagate.h, fitted to motion capture: autoregression of second order by least
// squares at 30 Hz, pooled over two trials each of Bandai-Namco Research Motiondataset 1 (walk
// active, walk normal) and of OpenCap's validation (subject 4, walking1, walkingTS1; Uhlrich et al.
// 2023). Stationary deviations of the fitted processes are those of the data within 2 %, so nothing
// is lost by stating them. The root's place goes on at constant velocity but for noise, as large as
// the same trials' accelerations.
#pragma once

#include "tracker/motion/motion_model.h"

namespace walktrack {
inline namespace tracker {

// Coordinates without a walker, in the places of the residual angles that belong to one. A pair's
// right side follows the left.
inline constexpr ResidualAngle kRootHeight = kCrouch, kHipFlexion = kThigh, kKneeFlexion = kShank;

// The processes of the trunk's tilt and the joint angles; those of the root's height in leg
// lengths. kPace has none.
MarkovConstants free_constants(ResidualAngle residual);

// Angles of a particle, and a frame ago, become those of a person in the kneed walker's gait of the
// particle's aim at a share of its step: it is how a search's hypothesis looks. Sets tilt, hip
// flexions, knee flexions and the root's height.
void enter_figure(const MotionContext& context, double phase, WalkerParticle& particle);

// A particle that is first seen is on its way: its residual angles go on from `before` to `now` as
// fast from wherever noise has put them.
void keep_rates(const ResidualAngles& now, const ResidualAngles& before, WalkerParticle& particle);

class MarkovMotion : public MotionModel {
 public:
  explicit MarkovMotion(const BodyModel& model) : leg_(leg_length(model.body.lengths)) {}
  MarkovConstants constants(const MotionConfig& config, ResidualAngle residual) const override;
  double start_spread(const MotionConfig& config, ResidualAngle residual) const override;
  void initialise(const MotionContext& context, std::span<const double> phases,
                  std::span<WalkerParticle> particles) const override;
  void predict(const MotionContext& context, std::span<WalkerParticle> particles,
               std::span<Rng> rngs, std::span<Outcome> outcomes) const override;
  bool linearise_noise(const MotionContext& context, WalkerParticle& particle) const override;
  void apply_noise(const MotionContext& context, WalkerParticle& particle) const override;
  std::span<const NoiseGroup> noise_groups(Path path) const override;

 private:
  double leg_;  // m
};

}  // namespace tracker
}  // namespace walktrack
