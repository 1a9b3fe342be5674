// A particle reads its pose as another moment of a step.
//
// People put a foot down early, late or short. The walker of a particle that has missed a strike
// goes on swinging the leg that has come down; for a while the residual angles stray far enough to
// show the right pose all the same, then the hip sinks and the track is lost, or the legs are
// swapped. Here the pose stays as it is and the walker changes: it becomes that of any moment of
// a step of either leg, and the residual angles make up the new difference.
//
// Jumps between poses that look alike and follow from the kinematics: Sminchisescu & Triggs,
// "Kinematic jump processes for monocular 3D human tracking", CVPR 2003.
//
// This is a Metropolis-Hastings step along the walkers that show the same pose, with respect to the
// residuals' own distribution (tracker/motion/propagate.h): the moment that explains the pose with
// less straying is taken up. How fast they stray is drawn anew, so that the walker goes on as its
// moment does: a leg that merely passes the other one is soon told from the other leg. Walkers that
// fit their pose are left alone.
#pragma once

#include "tracker/motion/propagate.h"
#include "tracker/motion/step_library.h"

namespace walktrack {
inline namespace tracker {

// Reads it as a moment of one of `steps`. Whether the proposal was accepted; then walker, stance,
// controls, aim, ball and the residuals that stray (residual and residual_before)
// are the new ones. They show the particle's pose, but for the height of the hip, which the
// standing leg gives.
bool try_phase_jump(const MotionContext& context, const StepLibrary& steps,
                    WalkerParticle& particle, Rng& rng);

}  // namespace tracker
}  // namespace walktrack
