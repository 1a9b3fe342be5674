// Standing: a person who stays on both feet, as a regime of the particle beside walking
// (interacting multiple models, Blom & Bar-Shalom 1988). In every frame a standing particle may set
// off into a step, and a walking one stop; which of them live is for the images to say.
//
// Standing is a walker at rest on straight legs whose feet and trunk leave it slowly: no
// clock, no steps, no torques. A particle that sets off takes the pose as an early moment of a step
// of either leg, slower at first than the step will be; one that stops takes it as standing, with
// residuals that take the swinging leg in. Both keep the pose as it is
// (tracker/state/residual_angles.h).
#pragma once

#include "tracker/motion/step_library.h"
#include "tracker/state/residual_angles.h"

namespace walktrack {
inline namespace tracker {

// Of the residual angles of those who stand.
struct StandingProcess {
  NoiseScale scale;
  MarkovSteps markov;
};
StandingProcess standing_process(const MotionModel& moves, const MotionConfig& config, double dt);

// Makes a particle whose stance and residual angles are set stand, upright and at rest.
void stand(WalkerParticle& particle);

// One frame's chance to set off or to stop; whether it was taken. `context.standing` is there.
bool change_regime(const MotionContext& context, const StepLibrary& steps, WalkerParticle& particle,
                   Rng& rng);

}  // namespace tracker
}  // namespace walktrack
