// The walker of an average adult, and units in which the gaits of all bodies are the same: lengths
// by the leg length L (hip to sole), times by sqrt(L/g), masses by the body mass M, and therefore
// torques by M g L and impulses by M sqrt(g L).
//
// Segments: Winter, "Biomechanics and Motor Control of Human Movement", 4th ed. 2009, table 4.1 and
// fig. 4.1 (head, arms and trunk as one; shank and foot as one). The rolling foot has
// an arc radius of 0.3 L and its centre 5 cm in front of the shank at a stature of 1.75 m
// (walker_units.cpp).
#pragma once

#include "walker/kneed/kneed_walker.h"

namespace walktrack {
inline namespace gait {

struct WalkerUnits {
  double length = 1;   // m
  double mass = 1;     // kg
  double gravity = 1;  // m/s^2

  double time() const;     // s
  double speed() const;    // m/s
  double torque() const;   // N m
  double impulse() const;  // N s
};

// Average adult of a stature (m) and mass (kg) on a slope (rad, positive downhill).
KneedParameters adult_walker(double height, double mass, double slope = 0);

// The same proportions with L = M = g = 1.
KneedParameters unit_walker(double slope = 0);

// Units of any walker: L is the standing hip height.
WalkerUnits walker_units(const KneedParameters& parameters);

// Converts controls and states from the units `from` to `to`.
KneedControls scaled(const KneedControls& controls, const WalkerUnits& from, const WalkerUnits& to);
KneedState scaled(const KneedState& state, const WalkerUnits& from, const WalkerUnits& to);

}  // namespace gait
}  // namespace walktrack
