// Residual angles: the differences between a person's angles and those of the walker in its plane,
// of trunk and legs. With them a walker at one moment of its step can have the pose of another
// moment.
#pragma once

#include "tracker/motion/propagate.h"

namespace walktrack {
inline namespace tracker {

// -log of the density of the residuals (tracker/motion/propagate.h) without a constant; infinite
// beyond their limits.
double residual_energy(const MotionContext& context, const ResidualAngles& residual);

// Sets the residuals of `proposal`, whose walker, stance and aim are set, so that its pose is
// `pose`.
void fit_residuals_to(const Pose& pose, WalkerParticle& proposal);

// Draws the residuals of a frame ago, given those of now.
void draw_residuals_before(const MotionContext& context, WalkerParticle& proposal, Rng& rng);

// Moves the ball of the supporting foot so that the root of `proposal` is above that of `pose`.
void stand_under(const BodyModel& model, const Pose& pose, WalkerParticle& proposal);

// A Metropolis-Hastings step: `proposal`, whose walker, stance and aim are set, replaces the
// particle if it explains the particle's pose with more probable residuals; returns whether it did.
// If both are beyond their limits, or if no residual angle has a process, the particle stays.
bool try_proposal(const MotionContext& context, WalkerParticle proposal, WalkerParticle& particle,
                  Rng& rng);

}  // namespace tracker
}  // namespace walktrack
