// The kneed walker of the reference file, as the kernel and as a linkage, and random states of it.
#pragma once

#include "tests/mechanics/random_state.h"
#include "tests/walker/kneed_files.h"
#include "walker/kneed/kneed_advance.h"
#include "walker/linkage/linkage_walker.h"
#include "walker/linkage/models.h"

namespace walktrack {

inline const ReferenceFile& reference() {
  static const ReferenceFile file = read_kneed_reference();
  return file;
}

inline LinkageWalker reference_walker(double impulse = 0) {
  KneedControls controls = reference().controls;
  controls.toe_off_impulse = impulse;
  return LinkageWalker(kneed(reference().parameters, controls, {.may_fly = false}));
}

// The kernel's state as a WalkerState, with the flags of the knees' stops.
inline WalkerState same_state(const KneedParameters& p, const KneedState& kneed) {
  WalkerState state;
  state.q = kneed.q;
  state.qd = kneed.qd;
  state.active = (kneed.stance_stop ? 1u : 0u) | (kneed.swing_stop ? 2u : 0u);
  state.contacts = {kneed.contact_x, kneed.contact_x + p.foot_radius * kneed.q(kStanceShank)};
  return state;
}

inline KneedState random_kneed(Rng& rng) {
  KneedState state;
  state.q = random_vector(rng, 5, 0.5);
  state.qd = random_vector(rng, 5, 3);
  state.contact_x = rng.uniform();
  state.stance_stop = rng.uniform() < 0.3;
  state.swing_stop = rng.uniform() < 0.3;
  return state;
}

}  // namespace walktrack
