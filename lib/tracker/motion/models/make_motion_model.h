// Makes the motion model that the configuration chooses.
#pragma once

#include <memory>

#include "gait/prior/gait_prior.h"
#include "tracker/motion/motion_model.h"

namespace walktrack {
inline namespace tracker {

// The model of that body, with the prior's gaits if the model uses them.
std::unique_ptr<const MotionModel> make_motion_model(MotionKind kind, const BodyModel& model,
                                                     const GaitPrior& prior);

}  // namespace tracker
}  // namespace walktrack
