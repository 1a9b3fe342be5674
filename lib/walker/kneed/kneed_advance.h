// The kneed walker through time: RK4 between events that are located in time and handled one after
// the other. Never throws, never loops without bound, never leaves a NaN unreported.
//
// Events
// - A knee reaches its stop (flexion 0): plastic impulse [M -a; a' 0][qd+; rho] = [M qd-; 0] with
//   rho >= 0, simultaneous stops stacked. The stop then holds by a reactive torque until it would
//   have to pull; a separating rate frees it.
// - Strike: the swing arc's lowest point crosses the ground downwards while ahead of the stance
//   foot. Grazing behind it is ignored and kept as KneedState::clearance. A foot that is under the
//   ground when it passes the stance foot strikes at that instant if it still descends, otherwise
//   the walker stumbles: fallen. At a strike the support transfer is applied and the call returns,
//   so that the caller can choose the next step's controls.
#pragma once

#include "walker/kneed/kneed_walker.h"

namespace walktrack {
inline namespace walker {

struct KneedLimits {
  double max_step = 0.004;      // s, RK4 sub-step; a walker's knee events need no finer one
  double min_hip_height = 0.6;  // of the standing height; a person does not walk lower
  double max_torso_lean = 1.0;  // rad either way; beyond it people fall or bend down
};

enum class KneedEvent {
  kNone,      // the whole duration has passed
  kTransfer,  // a strike, already applied
  kFallen,    // hip too low, torso beyond its limit, or the swing foot stumbled
  kDiverged,  // not finite, too stiff for the smallest step, or more events than a walker can have
};

struct KneedAdvance {
  double elapsed = 0;  // s
  KneedEvent event = KneedEvent::kNone;
  // At a transfer:
  Vector2 impulse = Vector2::Zero();  // N s, of the ground on the new stance foot
  double step_length = 0;             // m, between the feet's arc centres at the strike
  double clearance = 0;               // m, KneedState::clearance of the step that ended
};

// Moves `state` on by `duration` (s, >= 0) or to the next transfer, whichever comes first. `noise`
// is a generalised torque (N m) held throughout. After kFallen and kDiverged the state is the last
// one that was sound.
KneedAdvance kneed_advance(const KneedModel& model, const KneedControls& controls,
                           const Vector5& noise, KneedState& state, double duration,
                           const KneedLimits& limits = {});

// Makes a state consistent with its knee stops: flexion below zero is put to zero, rates into a
// stop are taken by the plastic impulse, and a stop is set only while it has to push. Returns the
// stops' impulses (stance, swing), N m s, >= 0.
std::array<double, 2> settle_knee_stops(const KneedModel& model, const KneedControls& controls,
                                        const Vector5& noise, KneedState& state);

// The sub-step that explicit RK4 takes at this state: small against the fastest spring and damper.
double kneed_step_size(const KneedModel& model, const KneedControls& controls,
                       const KneedState& state, double max_step);

}  // namespace walker
}  // namespace walktrack
