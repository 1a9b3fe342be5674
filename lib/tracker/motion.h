// How a particle gets from one frame to the next: the kneed walker under its springs, new controls
// at every support transfer, and Markov processes for what the walker does not drive.
//
//   k_t = k_(t-1) + a (k_(t-1) - k_(t-2)) + b (k0 - k_(t-1)) + noise,
//   r = exp(-dt / time), a = r^2, b = (1 - r)^2: critically damped,
//   noise ~ N(0, s^2 (1 - r^2)^3 / (1 + r^2)): s is the process's own standard deviation
// so that the process does not depend on the frame rate; truncated at anatomical limits. The
// heading has no rest: b = 0, and its rate has the standard deviation s.
#pragma once

#include <span>

#include "gait/gait_prior.h"
#include "tracker/particle.h"
#include "tracker/step_book.h"
#include "walker/kneed_advance.h"

namespace walktrack {

// For an adult of kAdultHeight.
struct MotionConfig {
  // Torque noise as shares of M g L per sqrt(s), L the leg's length: torso, hip, knees and, for the
  // ground under the stance foot, ankle.
  double torso_torque = 0.010;
  double hip_torque = 0.012;
  double stance_knee_torque = 0.008;
  double swing_knee_torque = 0.004;
  double ankle_torque = 0.040;
  double clock = 0.05;          // s per sqrt(s): how far people's phase strays from the walker's
  double turning = 0.08;        // rad/s: the usual rate of turning
  double misfit = 0.7;          // multiplies how far people's angles stray from the walker's
  double ball_drift = 0.03;     // m per sqrt(s): the drawn foot does not roll as the walker's does
  double ball_slip = 0.012;     // m per sqrt(s): nor does a standing foot quite keep its line
  double landing = 0.02;        // m, along and across: where a foot comes down
  double settling = 0.05;       // s after the strike in which that uncertainty dies away
  double arrival = 0.15;        // m, the same when a walker is first seen
  double control_noise = 0.05;  // relative, per step (gait/gait_prior.h)
  double feedback = 1;          // strength of the correction of controls at a support transfer
  double aim_drift = 0.06;      // relative, per step, of the speed and the step length aimed at
  double rephasing = 30;        // 1/s: how often a particle reads its pose anew (tracker/rephase.h)
  double torque_noise_scale = 0.15;  // multiplies all five torques
};

// The same for somebody larger or smaller, who walks to scale: lengths grow in proportion to the
// height, times with its square root, as gravity is what it is.
inline constexpr double kAdultHeight = 1.75;  // m
MotionConfig to_scale(const MotionConfig& config, double height);

// Constants of the Markov process of one extra coordinate.
struct MarkovConstants {
  double rest, time, spread;  // rad, s, rad (the heading: rad/s)
  double lowest, highest;     // rad
};
MarkovConstants markov_constants(Extra extra);

NoiseScale noise_scale(const MotionConfig& config, const BodyModel& model, double dt);

struct MotionContext {
  const BodyModel& model;
  const GaitPrior& prior;
  const StepBook& steps;
  MotionConfig config;
  NoiseScale scale;
  double dt;  // s
};

// Who falls, or whose state grows beyond bounds, is caught (goes on as the prior's gait); dead is
// only who has no state left to go on from.
enum class Outcome { kAlive, kFallen, kDiverged, kDead };

// The first frame of a particle: nothing moves, but its noise is drawn.
Outcome arrive(const MotionContext& context, WalkerParticle& particle, Rng& rng);
// One frame forward and its noise drawn, everybody's from their own stream (spans of one size). A
// particle's result does not depend on those that go with it, the time that it takes does.
void propagate(const MotionContext& context, std::span<WalkerParticle> particles,
               std::span<Rng> rngs, std::span<Outcome> outcomes);
Outcome propagate(const MotionContext& context, WalkerParticle& particle, Rng& rng);

// Changes some of the frame's noise, reversibly with respect to its prior, and realises it.
void perturb(const MotionContext& context, double boldness, WalkerParticle& particle, Rng& rng);

}  // namespace walktrack
