// The motion model `markov` has no walker and no ground. Root, trunk and every joint angle follow
// Markov processes of their own, which model how people's angles are distributed and how fast they
// change, but not that feet stand and that the legs alternate.
//
// Processes of the angles and of the root's height are the damped ones of
// tracker/motion/propagate.h, fitted to motion capture: autoregression of second order by least
// squares at 30 Hz, pooled over two trials each of Bandai-Namco Research Motiondataset 1 (walk
// active, walk normal) and of OpenCap's validation (subject 4, walking1, walkingTS1; Uhlrich et al.
// 2023). The stationary deviations of the fitted processes are those of the data within 2 %, so
// that they can be stated instead. The root moves at constant velocity with noise that is as large
// as the accelerations in the same trials.
#pragma once

#include "tracker/motion/motion_model.h"

namespace walktrack {
inline namespace tracker {

// Coordinates without a walker, which use the places of the residual angles. In a pair the right
// side follows the left.
inline constexpr ResidualAngle kRootHeight = kCrouch, kHipFlexion = kThigh, kKneeFlexion = kShank;

// The processes of the trunk's tilt and the joint angles; those of the root's height in leg
// lengths. kPace has none.
MarkovConstants free_constants(ResidualAngle residual);

// Sets the angles of a particle, now and a frame ago, to those of a person in the gait of the kneed
// walker at which the particle aims, at a share of its step: these are the angles of the search's
// figures. Sets tilt, hip flexions, knee flexions and the root's height.
void enter_figure(const MotionContext& context, double phase, WalkerParticle& particle);

// The first frame of a particle: its residual angles keep the velocity from `before` to `now`, from
// the values that noise has given them.
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
