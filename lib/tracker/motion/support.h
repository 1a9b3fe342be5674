// The stance foot: how uncertain its place is, and where the next foot comes down.
#pragma once

#include "tracker/motion/propagate.h"

namespace walktrack {
inline namespace tracker {

// Standard deviations of the stance foot's place in a frame, along and across the heading, m.
Eigen::Vector2d foot_sigma(const MotionContext& context, const WalkerParticle& particle);

// The swing foot has come down, and the particle stands on it. The walker's legs have already
// changed roles; `shown` is its state after that, with a person's leg angles.
void change_feet(const BodyModel& model, const KneedState& shown, WalkerParticle& particle);

// Changes the aim of a new step a little from that of the last one.
void perturb_step_target(const MotionConfig& config, StepAim& aim, Rng& rng);

}  // namespace tracker
}  // namespace walktrack
