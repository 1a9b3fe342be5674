// Phase jumps: the pose of a particle is explained by another moment of a step.
//
// People put a foot down early, late or with a short step. The walker of a particle that has missed
// a strike continues to swing the leg that has come down. For a while the residual angles can
// compensate for this; then the hip sinks and the track is lost, or the legs are swapped. A phase
// jump keeps the pose and changes the walker: it becomes the walker at any moment of a step of
// either leg, and the residual angles take the new difference.
//
// Similar jumps between poses that look alike: Sminchisescu & Triggs,
// "Kinematic jump processes for monocular 3D human tracking", CVPR 2003.
//
// This is a Metropolis-Hastings step over the walkers that show the same pose, with respect to the
// distribution of the residual angles (tracker/motion/propagate.h): a moment that explains the pose
// with smaller residuals is preferred. The rates of the residuals are drawn anew, so that the
// walker continues with the motion of its new moment and soon shows whether the legs are the right
// ones. Walkers that fit their pose are left alone.
#pragma once

#include "tracker/motion/propagate.h"
#include "tracker/motion/step_library.h"

namespace walktrack {
inline namespace tracker {

// Proposes a moment of one of `steps` and returns whether the proposal was accepted; then walker,
// stance, controls, aim, ball and the residual angles (residual and residual_before) are the new
// ones. They give the particle's pose, except for the height of the hip, which follows from the
// stance leg.
bool try_phase_jump(const MotionContext& context, const StepLibrary& steps,
                    WalkerParticle& particle, Rng& rng);

}  // namespace tracker
}  // namespace walktrack
