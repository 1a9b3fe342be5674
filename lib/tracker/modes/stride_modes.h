// Which leg is which: the hypotheses that a set of particles still holds.
//
// A silhouette from the side looks the same with the legs swapped, and a walker with swapped
// legs is one half a stride away: the left foot does what the right one is thought to do. A
// particle's place in the stride (0 = its left foot strikes, 1/2 = its right one) thus tells the
// hypotheses apart in every frame, also while the legs pass each other and look the same either
// way. Particles are of one mode with those less than a quarter of a stride away. That a set passes
// from one mode to the other while nothing moves that way is label switching (Stephens, "Dealing
// with label switching in mixture models", JRSS B 62, 2000).
#pragma once

#include <span>
#include <vector>

#include "tracker/state/particle.h"

namespace walktrack {
inline namespace tracker {

struct StrideModes {
  double phase = 0;           // of the mode reported, shares of the stride in [0, 1)
  double p_legs_swapped = 0;  // mass of the other one: probability that the legs are swapped,
                              // in a FrameRecord of walker_filter.h with that left by the start
  double standing = 0;  // probability of standing; above one half there is no phase to speak of
};

// In [0, 1).
double stride_phase(const WalkerParticle& particle);

// Middle of the heavier of two modes half a stride apart. Weights sum to one.
double leading_phase(std::span<const double> phases, std::span<const double> weights);

// Whether two places in the stride are more than a quarter of it from each other.
bool apart(double phase, double other);

// Weight of what is more than a quarter of a stride from `phase`.
double mass_apart(double phase, std::span<const double> phases, std::span<const double> weights);

StrideModes stride_modes(std::span<const WalkerParticle> particles,
                         std::span<const double> weights);

// Where in the stride those who are reported will be `dt` s later, if they go on.
double phase_ahead(std::span<const WalkerParticle> particles, std::span<const double> weights,
                   double dt);

// Whether a set, while the legs pass each other at about a quarter and three quarters of the
// stride, is half a stride from where it was expected, each give or take an eighth. No gait
// does that: the particles have taken one leg for the other.
bool label_switched(double expected, double phase);

}  // namespace tracker
}  // namespace walktrack
