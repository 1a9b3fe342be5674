// Advances many kneed walkers in time at once: kneed_advance() for each of them, several in a
// vector (double precision, Google Highway, instruction set chosen at run time).
//
// A lane with an event (a knee's stop, a strike) leaves its vector; events are located in vectors
// of their own, and their walkers continue in others, so that no walker waits. Every walker's
// result depends on that walker alone: the same bytes in any batch, in any order, on any number of
// threads, for one instruction set. It equals that of kneed_advance() except for rounding (1e-9
// over a step); instruction sets without fused multiply-add round differently.
#pragma once

#include <span>

#include "walker/kneed/kneed_advance.h"

namespace walktrack {
inline namespace walker {

// Advances states[i] by durations[i] (s) or to its next transfer with controls[i] and noise[i], and
// writes the result of kneed_advance() to results[i]. A walker with duration 0 does not change and
// costs nothing. All spans have the same size.
void kneed_advance_batch(const KneedModel& model, std::span<const KneedControls> controls,
                         std::span<const Vector5> noise, std::span<const double> durations,
                         std::span<KneedState> states, std::span<KneedAdvance> results,
                         const KneedLimits& limits = {});

}  // namespace walker
}  // namespace walktrack
