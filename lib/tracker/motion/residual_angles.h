// How far people's angles stray from the walker's in its plane, trunk and legs: what makes a walker
// at one moment of its step show the pose of another.
#pragma once

#include <cstddef>

#include "tracker/motion/motion.h"

namespace walktrack {

// The strays are the residual angles from kTilt on, in this number: trunk, thighs, shanks.
inline constexpr size_t kStrayCount = kShankRight - kTilt + 1;

// -log of the strays' own density (tracker/motion/motion.h), but for a constant; infinite beyond
// their limits.
double strays_improbability(const MotionContext& context, const ResidualAngles& residual);

// Gives `reading`, whose walker, stance and aim are set, the strays with which it shows `pose`.
void stray_to(const Pose& pose, WalkerParticle& reading);

// Strays of a frame ago, drawn as those of now let expect.
void draw_strays_before(const MotionContext& context, WalkerParticle& reading, Rng& rng);

// Puts the ball of the standing foot where `reading` has its root over that of `pose`.
void stand_under(const BodyModel& model, const Pose& pose, WalkerParticle& reading);

}  // namespace walktrack
