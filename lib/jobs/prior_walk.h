// A walk out of the table of gaits: at every support transfer the kneed walker takes the controls
// of the gait at the speed wanted by then, corrected by the feedback: `walktrack simulate --prior`.
#pragma once

#include "gait/walk_plan.h"
#include "jobs/simulate.h"

namespace walktrack {

// The job with start, controls and later steps out of the shipped table, for the parameters of
// `job.model`; good for one walk, whose progress it keeps. UsageError where the model is not the
// kneed walker with a torso and where the table does not hold a speed of the plan.
SimulateJob with_prior(SimulateJob job, const WalkPlan& plan);

}  // namespace walktrack
