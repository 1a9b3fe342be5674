// Moves a walker through time: smooth steps between events that are located in time and handled one
// after the other, also when several fall on the same instant.
//
// An event is located to `event_tolerance` by repeating the last step with a shorter dt. A guard
// that dips below zero and returns within one step (grazing) is found by its rate. More events than
// `max_events` before the step is complete mean that the walker chatters: diverged.
// Never throws, never loops without bound, never leaves a NaN in a state that is called sound.
#pragma once

#include <functional>
#include <vector>

#include "mechanics/integrator.h"
#include "walker/walker.h"

namespace walktrack {
inline namespace walker {

struct SimulationOptions {
  Integrator integrator = Integrator::kRk4;
  double max_step = 1e-3;          // s
  double event_tolerance = 1e-12;  // s
  int max_events = 64;             // per step of the walker; people's steps have fewer than ten
  double max_rate = 1e6;           // |qd| in SI beyond which the walker is called diverged
};

struct WalkerEvent {
  double time = 0;  // s
  Transition transition;
};

// Called with every state, also before and after events.
using StateObserver = std::function<void(const WalkerState&)>;

// Moves `state` on by `duration` (s, >= 0) or to the event that completes a step, whichever is
// first. Events are appended to `events`. Returns whether a step was completed; state.health tells
// the rest.
bool advance(const Walker& walker, WalkerState& state, double duration,
             const SimulationOptions& options, std::vector<WalkerEvent>& events,
             const StateObserver& observe = {});

// One whole step: from a section to the next. nullopt when the walker falls, diverges or needs
// longer than `max_time`.
struct WalkerStep {
  WalkerState end;
  double period = 0;         // s
  double travel = 0;         // m, of the body
  double step_length = 0;    // m, between the feet; less than the travel where feet roll
  double positive_work = 0;  // J, positive actuator work with the impulses' work
  double lowest_normal = 0;  // N, smallest normal force of the ground while in contact
  std::vector<WalkerEvent> events;
};
std::optional<WalkerStep> take_step(const Walker& walker, const WalkerState& start,
                                    const SimulationOptions& options, double max_time);

}  // namespace walker
}  // namespace walktrack
