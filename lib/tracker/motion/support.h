// The foot that a walker stands on: how surely it stands where it stands, and where the next one
// comes down.
#pragma once

#include "tracker/motion/propagate.h"

namespace walktrack {
inline namespace tracker {

// Standard deviations of the standing foot's place in a frame, along and across the heading, m.
Eigen::Vector2d foot_sigma(const MotionContext& context, const WalkerParticle& particle);

// The swing foot has come down: the particle stands on it. The walker's legs have exchanged their
// names already; `shown` is its state with the new names, as the person shows it.
void change_feet(const BodyModel& model, const KneedState& shown, WalkerParticle& particle);

// A new step aims a little differently from the last.
void perturb_step_target(const MotionConfig& config, StepAim& aim, Rng& rng);

}  // namespace tracker
}  // namespace walktrack
