#include "tracker/moves/phase_jump.h"

#include <cmath>

#include "tracker/motion/strays.h"

namespace walktrack {

bool try_phase_jump(const MotionContext& context, const StepLibrary& steps,
                    WalkerParticle& particle, Rng& rng) {
  const LibraryStep* step = steps.near(particle.aim, particle.residual[kHeading], rng);
  if (step == nullptr) return false;
  WalkerParticle reading = particle;
  reading.aim = step->aim;
  reading.controls = step->controls;
  reading.walker = step->moments[static_cast<size_t>(rng.uniform() * LibraryStep::kMoments)];
  if (rng.uniform() < 0.5) reading.stance = other(particle.stance);
  stray_to(particle.pose, reading);
  const double gain = strays_improbability(context, particle.residual) -
                      strays_improbability(context, reading.residual);
  // Without a number, when both stray beyond limits or nothing may stray, the pose is kept as read.
  if (!(std::log(rng.uniform()) < gain)) return false;
  draw_strays_before(context, reading, rng);
  stand_under(context.model, particle.pose, reading);
  particle = reading;
  return true;
}

}  // namespace walktrack
