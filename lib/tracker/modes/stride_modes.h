// Which leg is which: the two modes of a set of particles.
//
// From the side a silhouette looks the same with the legs swapped, and a walker with swapped legs
// is half a stride away: its left foot does what the right one does. The phase of a particle in the
// stride (0 = its left foot strikes, 1/2 = its right foot strikes) therefore distinguishes the
// modes in every frame, also while the legs pass each other and look the same in both modes.
// Particles whose phases differ by less than a quarter of a stride belong to the same mode. If a
// set changes from one mode to the other without a motion that explains it, this is label switching
// (Stephens, "Dealing with label switching in mixture models", JRSS B 62, 2000).
#pragma once

#include <span>
#include <vector>

#include "tracker/state/particle.h"

namespace walktrack {
inline namespace tracker {

struct StrideModes {
  double phase = 0;  // of the reported mode, as a share of the stride in [0, 1)
  // Weight of the other mode: the probability that the legs are swapped; in a FrameRecord
  // (walker_filter.h) including that of the start
  double p_legs_swapped = 0;
  double standing = 0;  // probability of standing; above one half the phase has no meaning
};

// In [0, 1).
double stride_phase(const WalkerParticle& particle);

// Middle of the heavier of two modes half a stride apart. Weights sum to one.
double leading_phase(std::span<const double> phases, std::span<const double> weights);

// Whether two phases are more than a quarter of a stride apart.
bool apart(double phase, double other);

// Whether two phases are half a stride apart, give or take an eighth.
bool mirrored(double phase, double other);

// Weight of the particles that are more than a quarter of a stride from `phase`.
double mass_apart(double phase, std::span<const double> phases, std::span<const double> weights);

StrideModes stride_modes(std::span<const WalkerParticle> particles,
                         std::span<const double> weights);

// The phase of the reported mode `dt` s later.
double phase_ahead(std::span<const WalkerParticle> particles, std::span<const double> weights,
                   double dt);

// Whether a set is half a stride (give or take an eighth) from the expected phase while the legs
// pass each other, at about a quarter and three quarters of the stride (give or take an eighth). In
// no gait this happens: the particles have swapped the legs.
bool label_switched(double expected, double phase);

}  // namespace tracker
}  // namespace walktrack
