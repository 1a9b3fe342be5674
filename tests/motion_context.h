// The context of particles without a tracker.
#pragma once

#include "tracker/motion/propagate.h"

namespace walktrack {

inline MotionContext motion_context(const BodyModel& model, const GaitPrior& prior,
                                    const MotionModel& moves, const MotionConfig& config,
                                    double dt) {
  return {model,
          prior,
          moves,
          config,
          noise_scale(moves, config, model, dt),
          markov_steps(moves, config, dt),
          dt};
}

}  // namespace walktrack
