// Standing: a person who stays on both feet, as a regime of the particle beside walking
// (interacting multiple models, Blom & Bar-Shalom 1988). In every frame a standing particle may
// start to walk, and a walking one may stop; the images decide which of them survive.
//
// Standing is a walker at rest on straight legs, from whose pose feet and trunk deviate slowly; it
// has no phase, no steps and no torques. For a particle that starts to walk, the pose becomes an
// early moment of a step of either leg, which is slower at first than the step will be. For a
// particle that stops, the pose becomes standing, with residuals that bring the swinging leg back.
// Both keep the pose as it is (tracker/state/residual_angles.h).
#pragma once

#include "tracker/motion/step_library.h"
#include "tracker/state/residual_angles.h"

namespace walktrack {
inline namespace tracker {

// Processes of the residual angles while the subject stands.
struct StandingProcess {
  NoiseScale scale;
  MarkovSteps markov;
};
// Whether a subject may stand: only the kneed walker can.
bool may_stand(const MotionConfig& config);

StandingProcess standing_process(const MotionModel& moves, const MotionConfig& config, double dt);

// Makes a particle, whose stance and residual angles are set, stand upright and at rest.
void stand(WalkerParticle& particle);

// Draws whether the particle starts to walk or stops in this frame, and returns whether it did.
// With `context.all_set_off` every particle that stands starts, if a step fits its pose.
// `context.standing` has to be set.
bool change_regime(const MotionContext& context, const StepLibrary& steps, WalkerParticle& particle,
                   Rng& rng);

}  // namespace tracker
}  // namespace walktrack
