// Residual angles: the differences between a person's angles and the walker's in its plane, of
// trunk and legs. With them a walker at one moment of its step can show the pose of another moment.
#pragma once

#include "tracker/motion/propagate.h"

namespace walktrack {
inline namespace tracker {

// -log of the density of the residuals (tracker/motion/propagate.h) without a constant; infinite
// beyond their limits.
double residual_energy(const MotionContext& context, const ResidualAngles& residual);

// Sets the residuals of `reading`, whose walker, stance and aim are set, so that its pose is
// `pose`.
void fit_residuals_to(const Pose& pose, WalkerParticle& reading);

// Draws the residuals of a frame ago, given those of now.
void draw_residuals_before(const MotionContext& context, WalkerParticle& reading, Rng& rng);

// Moves the ball of the stance foot so that the root of `reading` is over that of `pose`.
void stand_under(const BodyModel& model, const Pose& pose, WalkerParticle& reading);

// A Metropolis-Hastings step: `reading`, whose walker, stance and aim are set, replaces the
// particle if it explains the particle's pose with more probable residuals; returns whether it did.
// If both are beyond their limits, or if no residual angle has a process, the particle stays and no
// random number is drawn.
bool try_reading(const MotionContext& context, WalkerParticle reading, WalkerParticle& particle,
                 Rng& rng);

}  // namespace tracker
}  // namespace walktrack
