// A walk with controls from a table of gaits: at every support transfer the walker gets the
// controls of the gait at the present target speed, corrected by the feedback: `walktrack simulate
// --prior`.
#pragma once

#include "gait/walk_plan.h"
#include "jobs/simulate/simulate_job.h"

namespace walktrack {
inline namespace jobs {

// The job with start, controls and later steps from the shipped table, for the parameters of
// `job.model`; it can be run once, because it stores the progress of the walk. UsageError if the
// model is neither the kneed walker with a torso nor the anthropomorphic one, and if the table has
// no gait for a speed of the plan, for its step length or for the slope.
SimulateJob with_prior(SimulateJob job, const WalkPlan& plan);

}  // namespace jobs
}  // namespace walktrack
