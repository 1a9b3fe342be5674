// The supporting foot: the uncertainty of its place, and the place of the next foot.
#pragma once

#include "tracker/motion/propagate.h"

namespace walktrack {
inline namespace tracker {

// Standard deviations of the stance foot's place in a frame, along and across the heading, m.
Eigen::Vector2d foot_sigma(const MotionContext& context, const WalkerParticle& particle);

// The swing foot has landed and becomes the supporting foot. The walker's legs have already changed
// roles; `shown` is its state after that, with a person's leg angles.
void change_feet(const BodyModel& model, const KneedState& shown, WalkerParticle& particle);

// The share of its step after which the hips of a walker that stumbles are where they are now: they
// travel the step's length, m. `ahead`: from their place at the beginning of the step, m. What is
// left of the difference moves the supporting foot, because images show the hips' place better.
double phase_of_hips(const Eigen::Vector2d& ahead, double step_length,
                     const WalkerParticle& particle);

// Draws the target of a new step near that of the last one.
void perturb_step_target(const MotionConfig& config, StepAim& aim, Rng& rng);

}  // namespace tracker
}  // namespace walktrack
