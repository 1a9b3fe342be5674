// Propagates a particle from one frame to the next: its walker is simulated
// (tracker/motion/motion_model.h), and the coordinates that the walker does not drive follow damped
// second-order Markov processes.
//
//   k_t = k_(t-1) + a (k_(t-1) - k_(t-2)) + b (k0 - k_(t-1)) + noise,
//   r = exp(-dt / time), w = 2 pi dt / period, a = r^2, b = 1 + r^2 - 2 r cos w,
//   noise ~ N(0, s^2 (1 - r^2) ((1 - r^2)^2 + 4 r^2 sin^2 w) / (1 + r^2)):
//   s is the process's own standard deviation
// so that the process does not depend on the frame rate; truncated at anatomical limits. Without a
// period w = 0: critically damped. The heading has no rest: a = r, b = 0, and its rate has the
// standard deviation s. Because people face the direction in which they walk, the heading relaxes
// to the direction of travel of about the last step with the time constant
// MotionConfig::heading_time_constant. On a sagittal path the heading is constant.
#pragma once

#include <array>
#include <span>

#include "gait/prior/gait_prior.h"
#include "tracker/motion/motion_model.h"

namespace walktrack {
inline namespace tracker {

// For an adult of kAdultHeight. By hand unless stated otherwise.
struct MotionConfig {
  MotionKind model = MotionKind::kKneed;
  Path path = Path::kSpatial;  // BodyModel::path
  // Torque noise as shares of M g L per sqrt(s), L the leg's length: torso, hip, knees and, for the
  // ground under the stance foot, ankle.
  double torso_torque = 0.010;
  double hip_torque = 0.012;
  double stance_knee_torque = 0.008;
  double swing_knee_torque = 0.004;
  double ankle_torque = 0.040;
  double phase_noise = 0.05;  // s per sqrt(s): random drift of the phase of the stride
  double yaw_rate_sd = 0.08;  // rad/s: standard deviation of the rate of turning
  // rad/s: the same of components that turn (tracker/modes/turning.h); 0: there are none
  double turning_yaw_rate_sd = 0.6;
  // s: time constant with which the heading relaxes to the direction of travel
  double heading_time_constant = 0.3;
  double residual_scale = 0.7;  // multiplies the spreads of the residual angles
  // m per sqrt(s), along the walk: a real foot does not roll like the walker's
  double ball_drift = 0.03;
  double ball_slip = 0.012;   // m per sqrt(s), across the walk
  double footfall_sd = 0.02;  // m, along and across: standard deviation of the place of a footfall
  double footfall_decay = 0.05;     // s after the strike in which that uncertainty decays
  double start_position_sd = 0.15;  // m, the same at a start
  double given_position_sd = 0.1;   // m, of the place that a scene states, before the images
  double control_noise = 0.05;      // relative, per step (gait/prior/gait_prior.h)
  double feedback = 1;              // strength of the correction of controls at a support transfer
  double aim_drift = 0.06;          // relative, per step, of the speed and the step length aimed at
  // 1/s: rate at which a particle proposes a phase jump (tracker/moves/phase_jump.h)
  double phase_jump_rate = 30;
  double torque_noise_scale = 0.15;  // multiplies all five torques
  // Whether the subject may stand, start to walk and stop (tracker/motion/standing.h)
  bool standing = true;
  // Multiplies the noise of model kMarkov; tuned on the demo, 1 = as fitted
  double markov_noise_scale = 1.5;
};

// The same for a subject of another height: lengths grow in proportion to the height, and times
// with its square root, because gravity is the same.
inline constexpr double kAdultHeight = 1.75;  // m
MotionConfig to_scale(const MotionConfig& config, double height);

// The process of a residual angle from frame to frame.
struct MarkovStep {
  double momentum = 0, pull = 0;             // a, b
  double rest = 0, lowest = 0, highest = 0;  // rad
};
using MarkovSteps = std::array<MarkovStep, kResidualCount>;
MarkovStep markov_step(ResidualAngle residual, const MarkovConstants& constants, double dt);
MarkovSteps markov_steps(const MotionModel& moves, const MotionConfig& config, double dt);

// Standard deviation of a frame's noise in a residual angle.
double frame_noise(const MotionConfig& config, ResidualAngle residual,
                   const MarkovConstants& constants, double dt);

NoiseScale noise_scale(const MotionModel& moves, const MotionConfig& config, const BodyModel& model,
                       double dt);

struct StandingProcess;  // tracker/motion/standing.h

struct MotionContext {
  const BodyModel& model;
  const GaitPrior& prior;
  const MotionModel& moves;
  MotionConfig config;
  NoiseScale scale;
  MarkovSteps markov;
  double dt;                                  // s
  const StandingProcess* standing = nullptr;  // if the subject may stand
  bool all_set_off = false;                   // all who stand start to walk in this frame
};

// The prior's gait at which a particle aims, on the slope of its heading.
PriorGait aimed_gait(const MotionContext& context, const WalkerParticle& particle);

// The first frame of a particle: nothing moves, and only its noise is drawn.
Outcome draw_first_noise(const MotionContext& context, WalkerParticle& particle, Rng& rng);
// Propagates by one frame and draws its noise, for each particle from its own stream (all spans
// have the same size). The result for a particle does not depend on the others in the spans.
void propagate(const MotionContext& context, std::span<WalkerParticle> particles,
               std::span<Rng> rngs, std::span<Outcome> outcomes);
Outcome propagate(const MotionContext& context, WalkerParticle& particle, Rng& rng);

// Changes some of the frame's noise, reversibly with respect to its prior, and applies it.
void perturb(const MotionContext& context, double step_size, WalkerParticle& particle, Rng& rng);

}  // namespace tracker
}  // namespace walktrack
