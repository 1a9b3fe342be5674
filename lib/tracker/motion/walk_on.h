// The physics of a frame: kneed walkers under their springs, with new controls and another standing
// foot at every support transfer. Walkers share vectors (walker/kneed/kneed_batch.h); what happens
// to one does not depend on the others.
#pragma once

#include <span>

#include "tracker/motion/propagate.h"

namespace walktrack {
inline namespace tracker {

// Moves particles[i].walker on by a frame, as long as its pace makes it, with numbers of rngs[i].
// outcomes[i] becomes kAlive, or what befell the walker before it was caught. Spans of one size.
void walk_on(const MotionContext& context, std::span<WalkerParticle> particles, std::span<Rng> rngs,
             std::span<Outcome> outcomes);

}  // namespace tracker
}  // namespace walktrack
