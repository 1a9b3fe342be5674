// Advances the kneed walker in time: RK4 between events that are located in time and handled one
// after the other. It never throws, never loops without bound, and reports every NaN.
//
// Events
// - A knee reaches its stop (flexion 0): plastic impulse [M -a; a' 0][qd+; rho] = [M qd-; 0] with
//   rho >= 0; simultaneous stops are solved together. The stop then holds by a reactive torque
//   until it would have to pull, or until the knee flexes.
// - Strike: the lowest point of the swing foot's arc crosses the ground downwards in front of the
//   stance foot. Contact behind it is ignored and recorded as KneedState::clearance. If the foot is
//   below the ground when it passes the stance foot, it strikes at that time if it still descends;
//   otherwise the walker stumbles: fallen. At a strike the support transfer is applied and the call
//   returns, so that the caller can choose the controls of the next step.
#pragma once

#include "walker/kneed/kneed_walker.h"

namespace walktrack {
inline namespace walker {

struct KneedLimits {
  double max_step = 0.004;      // s, largest RK4 sub-step; a walker's knee events need no smaller
                                // one
  double min_hip_height = 0.6;  // of the standing height; people do not walk lower
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

// Advances `state` by `duration` (s, >= 0) or to the next transfer, whichever comes first. `noise`
// is a constant generalised torque (N m). After kFallen and kDiverged the state is the last valid
// one.
KneedAdvance kneed_advance(const KneedModel& model, const KneedControls& controls,
                           const Vector5& noise, KneedState& state, double duration,
                           const KneedLimits& limits = {});

}  // namespace walker
}  // namespace walktrack
