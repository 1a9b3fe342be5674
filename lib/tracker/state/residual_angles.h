// How far people's angles stray from the walker's in its plane, trunk and legs: what makes a walker
// at one moment of its step show the pose of another.
#pragma once

#include "tracker/motion/propagate.h"

namespace walktrack {
inline namespace tracker {

// -log of the residuals' own density (tracker/motion/propagate.h), but for a constant; infinite
// beyond their limits.
double residual_energy(const MotionContext& context, const ResidualAngles& residual);

// Gives `reading`, whose walker, stance and aim are set, the residuals with which it shows `pose`.
void fit_residuals_to(const Pose& pose, WalkerParticle& reading);

// Residuals of a frame ago, drawn as those of now let expect.
void draw_residuals_before(const MotionContext& context, WalkerParticle& reading, Rng& rng);

// Puts the ball of the standing foot where `reading` has its root over that of `pose`.
void stand_under(const BodyModel& model, const Pose& pose, WalkerParticle& reading);

// Metropolis-Hastings: `reading`, whose walker, stance and aim are set, takes the particle's place
// where it explains the particle's pose with likelier residuals; whether it did. Without a number,
// when both are beyond limits or nothing may stray, the particle stays.
bool try_reading(const MotionContext& context, WalkerParticle reading, WalkerParticle& particle,
                 Rng& rng);

}  // namespace tracker
}  // namespace walktrack
