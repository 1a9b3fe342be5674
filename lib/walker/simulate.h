// Simulates a walker: smooth steps between events that are located in time and handled one after
// the other, also if several occur at the same time.
//
// An event is located to `event_tolerance` by repeating the last step with a shorter dt. A guard
// that is negative for a short time within one step (grazing) is found by its rate. More events
// than `max_events` before the step is complete mean that the walker chatters: diverged. The
// simulation never throws, never loops without bound, and never calls a state with NaN valid.
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
  double max_rate = 1e6;           // |qd| in SI above which the walker has diverged
};

struct WalkerEvent {
  double time = 0;  // s
  Transition transition;
};

// Called with every state, including those before and after events.
using StateObserver = std::function<void(const WalkerState&)>;

// Advances `state` by `duration` (s, >= 0) or to the event that completes a step, whichever comes
// first. Events are appended to `events`. Returns whether a step was completed; state.health has
// the rest.
bool advance(const Walker& walker, WalkerState& state, double duration,
             const SimulationOptions& options, std::vector<WalkerEvent>& events,
             const StateObserver& observe = {});

// One complete step: from a section to the next. nullopt if the walker falls, diverges or needs
// longer than `max_time`.
struct WalkerStep {
  WalkerState end;
  double period = 0;         // s
  double travel = 0;         // m, of the body
  double step_length = 0;    // m, between the feet; less than the travel if feet roll
  double positive_work = 0;  // J, positive actuator work including that of impulses
  double lowest_normal = 0;  // N, smallest normal force of the ground while in contact
  std::vector<WalkerEvent> events;
};
std::optional<WalkerStep> take_step(const Walker& walker, const WalkerState& start,
                                    const SimulationOptions& options, double max_time);

}  // namespace walker
}  // namespace walktrack
