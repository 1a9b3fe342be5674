// The physics of a frame: kneed walkers move under their springs, with new controls and another
// stance foot after every support transfer. Several walkers share a vector
// (walker/kneed/kneed_batch.h); the result for a walker does not depend on the others.
#pragma once

#include <span>

#include "tracker/motion/propagate.h"

namespace walktrack {
inline namespace tracker {

// Simulates particles[i].walker for a frame, whose length depends on its pace, with random numbers
// of rngs[i]. outcomes[i] becomes kAlive, or the reason for which the walker was caught. All spans
// have the same size.
void walk_on(const MotionContext& context, std::span<WalkerParticle> particles, std::span<Rng> rngs,
             std::span<Outcome> outcomes);

}  // namespace tracker
}  // namespace walktrack
