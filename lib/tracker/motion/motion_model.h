// The dynamics that move particles from frame to frame, chosen by the configuration:
//   kneed            the kneed walker, and Markov processes for what it does not drive
//                    (tracker/motion/models/kneed_motion.h)
//   anthropomorphic  two straight legs; knees and trunk are Markov processes as well
//                    (tracker/motion/models/anthropomorphic_motion.h)
//   markov           no walker: every coordinate is a Markov process
//   (tracker/motion/models/markov_motion.h)
// The other two exist to measure the contribution of physics: reports/physics.md.
#pragma once

#include <span>

#include "core/rng.h"
#include "tracker/state/particle.h"

namespace walktrack {
inline namespace tracker {

struct MotionConfig;
struct MotionContext;

enum class MotionKind { kKneed, kAnthropomorphic, kMarkov };

// A walker that falls, or whose state exceeds its bounds, is caught (it continues with the prior's
// gait); only a walker without a state to continue from is dead.
enum class Outcome { kAlive, kFallen, kDiverged, kDead };

// Indices of WalkerParticle::noise that are changed together.
using NoiseGroup = std::span<const int>;

class MotionModel {
 public:
  virtual ~MotionModel() = default;

  // The process of a residual angle. An angle without spread stays at its rest.
  virtual MarkovConstants constants(const MotionConfig& config, ResidualAngle residual) const = 0;

  // How far a residual angle may be from the gait that a particle enters with: the standard
  // deviation with which the first frame draws it, in the coordinate's own unit.
  virtual double start_spread(const MotionConfig&, ResidualAngle residual) const {
    return row_of(residual).process.spread;
  }

  // Particles whose aim, stance foot, heading and rest angles are set start at `phases` of their
  // steps, as shares of a step.
  virtual void initialise(const MotionContext& context, std::span<const double> phases,
                          std::span<WalkerParticle> particles) const = 0;

  // Before a frame: a particle may jump to another phase that explains its pose. Returns whether it
  // did.
  virtual bool jump_phase(const MotionContext&, WalkerParticle&, Rng&) const { return false; }

  // Predicts a frame without its noise: the walkers move and feet come down. outcomes[i] is never
  // kDead. The result for a particle does not depend on the others. All spans have the same size.
  virtual void predict(const MotionContext& context, std::span<WalkerParticle> particles,
                       std::span<Rng> rngs, std::span<Outcome> outcomes) const = 0;

  // Computes the effect of the frame's noise on a particle: predicted, velocity_per_impulse,
  // predicted_ball and ball_sigma. Returns false if the particle has no state to continue from.
  virtual bool linearise_noise(const MotionContext& context, WalkerParticle& particle) const = 0;

  // Sets the realised part of a particle from the predicted part and the noise.
  virtual void apply_noise(const MotionContext& context, WalkerParticle& particle) const = 0;

  // Groups of noise that move one part of the body; the two groups of the arms come last.
  virtual std::span<const NoiseGroup> noise_groups(Path path) const = 0;
};

}  // namespace tracker
}  // namespace walktrack
