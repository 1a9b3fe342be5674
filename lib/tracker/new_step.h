// A particle that begins its step anew. People put a foot down early, late or short, and a set of
// particles that has missed a step rarely finds back: all of them swing a leg that has long come
// down. So, some of the particles leave the gait that they were in and go on from any phase of a
// step of either leg, at the same place, speed and heading, as the gait of about the same aim.
//
// They are proposals, not what people are expected to do: such a particle must explain the frame
// better than those that went on by `kNewStepCost` nats.
#pragma once

#include "tracker/motion.h"

namespace walktrack {

inline constexpr double kNewStepCost = 12;

// Sets walker, controls, aim, stance, ball and pose_before; the particle's extras are those
// predicted for this frame. Its noise is still to be drawn.
void begin_step_anew(const MotionContext& context, WalkerParticle& particle, Rng& rng);

}  // namespace walktrack
