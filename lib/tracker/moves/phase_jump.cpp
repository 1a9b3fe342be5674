#include "tracker/moves/phase_jump.h"

#include "tracker/state/residual_angles.h"

namespace walktrack {
inline namespace tracker {

bool try_phase_jump(const MotionContext& context, const StepLibrary& steps,
                    WalkerParticle& particle, Rng& rng) {
  const LibraryStep* step = steps.near(particle.aim, particle.residual[kHeading], rng);
  if (step == nullptr) return false;
  WalkerParticle proposal = particle;
  proposal.aim = step->aim;
  proposal.controls = step->controls;
  proposal.walker = step->moments[static_cast<size_t>(rng.uniform() * LibraryStep::kMoments)];
  if (rng.uniform() < 0.5) proposal.stance = other(particle.stance);
  return try_proposal(context, proposal, particle, rng);
}

}  // namespace tracker
}  // namespace walktrack
