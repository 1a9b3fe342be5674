// Advances many anthropomorphic walkers in time at once, several in a vector, like kneed_batch.h:
// RK4 between strikes that are located in time. Every walker's result depends on that walker alone:
// the same bytes in any batch, in any order, on any number of threads, for one instruction set. It
// equals that of LinkageWalker (straight_legged()) except for rounding, 1e-9 over a step.
#pragma once

#include <span>

#include "walker/kneed/kneed_advance.h"
#include "walker/straight/straight_walker.h"

namespace walktrack {
inline namespace walker {

struct StraightAdvance {
  double elapsed = 0;  // s
  KneedEvent event = KneedEvent::kNone;
  // At a transfer, see StraightTransfer:
  Vector2 impulse = Vector2::Zero();  // N s
  double step_length = 0;             // m
  double toe_off_work = 0;            // J
  bool old_foot_lifts = true;
};

// Advances states[i] by durations[i] (s) or to its next transfer, with controls[i] and the
// generalised torque noise[i] (N m), in sub-steps of at most `max_step` (s), shorter if the spring
// requires it. A walker with duration 0 does not change. All spans have the same size.
void straight_advance_batch(const StraightModel& model, std::span<const StraightControls> controls,
                            std::span<const Vector2> noise, std::span<const double> durations,
                            std::span<StraightState> states, std::span<StraightAdvance> results,
                            double max_step = 0.004);

// One walker.
StraightAdvance straight_advance(const StraightModel& model, const StraightControls& controls,
                                 const Vector2& noise, StraightState& state, double duration,
                                 double max_step = 0.004);

}  // namespace walker
}  // namespace walktrack
