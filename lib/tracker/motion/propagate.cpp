#include "tracker/motion/propagate.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "core/conventions.h"
#include "tracker/motion/standing.h"
#include "tracker/state/noise_groups.h"

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::Vector2d;

// Arms swing opposite to the legs: forward with the other side's thigh.
double rest_of(ResidualAngle residual, const MarkovStep& step, const WalkerParticle& particle) {
  if (row_of(residual).left != kShoulder) return step.rest;
  constexpr double kArmPerLeg = 0.6;  // walking at 1.3 m/s, Murray et al. 1967
  const size_t other_leg = residual == kShoulder ? 1 : 0;
  return step.rest + kArmPerLeg * particle.pose.legs[other_leg].hip_flexion;
}

void predict_residuals(const MotionContext& context, WalkerParticle& particle) {
  const MarkovSteps& steps =
      particle.regime == Regime::kStanding ? context.standing->markov : context.markov;
  for (const ResidualAngle i : free_residuals(context.model)) {
    const MarkovStep& step = steps[i];
    const double now = particle.residual[i];
    const double next = now + step.momentum * (now - particle.residual_before[i]) +
                        step.pull * (rest_of(i, step, particle) - now);
    particle.residual_before[i] = now;
    particle.predicted_residual[i] = std::clamp(next, step.lowest, step.highest);
  }
}

Vector2d turned(const Vector2d& v, double angle) { return Eigen::Rotation2Dd(angle) * v; }

// Adds the velocity of the last frame to the mean velocity over the last step.
void update_travel_velocity(const MotionContext& context, WalkerParticle& particle) {
  const Pose &now = particle.pose, &before = particle.pose_before;
  const Vector2d velocity = (now.root - before.root).head<2>() / context.dt;
  const double kept = std::exp(-context.dt / particle.aim.duration());
  particle.way =
      kept * particle.way + (1 - kept) * turned(velocity, -0.5 * (now.heading + before.heading));
}

// The predicted heading relaxes to the direction of travel; this adds nothing to its rate.
void relax_heading_to_travel(const MotionContext& context, WalkerParticle& particle) {
  // The heading of a subject who hardly moves does not relax.
  const double ahead = std::max(particle.way.x(), 0.25 * particle.aim.speed);
  const double off = std::atan2(particle.way.y(), ahead);
  const double turn = off * (1 - std::exp(-context.dt / context.config.heading_time_constant));
  particle.predicted_residual[kHeading] += turn;
  particle.residual_before[kHeading] += turn;
  particle.way = turned(particle.way, -turn);
}

void draw_noise(const MotionContext& context, WalkerParticle& particle, Rng& rng) {
  for (size_t k = 0; k < kResidualNoise; ++k) particle.noise[k] = rng.truncated_normal(4);
  for (const ResidualAngle residual : free_residuals(context.model))
    particle.noise[size_t(noise_of(residual))] = rng.truncated_normal(4);
}

// The present walker becomes the prediction for the frame, and its noise is drawn.
bool predict(const MotionContext& context, WalkerParticle& particle, Rng& rng) {
  if (!context.moves.linearise_noise(context, particle)) return false;
  particle.predicted = particle.walker;
  particle.predicted_ball = particle.ball;
  draw_noise(context, particle, rng);
  context.moves.apply_noise(context, particle);
  return true;
}

}  // namespace

MarkovStep markov_step(ResidualAngle residual, const MarkovConstants& c, double dt) {
  const double r = std::exp(-dt / c.time);
  if (residual == kHeading) return {r, 0, 0, c.lowest, c.highest};
  const double swing = 1 - std::cos(2 * kPi * dt / c.period);
  return {r * r, (1 - r) * (1 - r) + 2 * r * swing, c.rest, c.lowest, c.highest};
}

MarkovSteps markov_steps(const MotionModel& moves, const MotionConfig& config, double dt) {
  MarkovSteps steps;
  for (const ResidualAngle residual : kAllResiduals)
    steps[residual] = markov_step(residual, moves.constants(config, residual), dt);
  return steps;
}

double frame_noise(const MotionConfig& config, ResidualAngle residual, const MarkovConstants& c,
                   double dt) {
  const double r = std::exp(-dt / c.time), rr = r * r;
  const double sine = std::sin(2 * kPi * dt / c.period);
  return residual == kHeading ? config.yaw_rate_sd * dt * std::sqrt(1 - rr)
                              : c.spread * std::sqrt(((1 - rr) * (1 - rr) + 4 * rr * sine * sine) *
                                                     (1 - rr) / (1 + rr));
}

MotionConfig to_scale(const MotionConfig& config, double height) {
  const double length = height / kAdultHeight, time = std::sqrt(length);
  MotionConfig scaled = config;
  scaled.torque_noise_scale *= std::sqrt(time);  // a share of M g L per root second
  scaled.phase_noise *= std::sqrt(time);
  scaled.yaw_rate_sd /= time;
  scaled.turning_yaw_rate_sd /= time;
  scaled.heading_time_constant *= time;
  scaled.ball_drift *= length / std::sqrt(time);
  scaled.ball_slip *= length / std::sqrt(time);
  scaled.footfall_sd *= length;
  scaled.footfall_decay *= time;
  scaled.start_position_sd *= length;
  scaled.given_position_sd *= length;
  scaled.phase_jump_rate /= time;
  return scaled;
}

NoiseScale noise_scale(const MotionModel& moves, const MotionConfig& config, const BodyModel& model,
                       double dt) {
  const KneedParameters& p = model.walker.parameters;
  const double leg = leg_length(model.body.lengths);
  const double unit = config.torque_noise_scale * model.walker.total_mass * p.gravity * leg;
  const double root = std::sqrt(dt);
  NoiseScale scale;
  const std::array<double, 5> shares{config.torso_torque, config.hip_torque,
                                     config.stance_knee_torque, config.swing_knee_torque,
                                     config.ankle_torque};
  for (size_t k = 0; k < 5; ++k) scale.impulse[k] = shares[k] * unit * root;
  scale.elapsed = dt;
  for (const ResidualAngle residual : kAllResiduals)
    scale.residual[residual] = frame_noise(config, residual, moves.constants(config, residual), dt);
  return scale;
}

PriorGait aimed_gait(const MotionContext& context, const WalkerParticle& particle) {
  const BodyModel& model = context.model;
  const StepAim& aim = particle.aim;
  const auto gait = [&](const KneedModel& walker) {
    return gait_at(context.prior, walker.parameters, aim.speed, aim.step_length);
  };
  return model.downhill.isZero() ? gait(model.walker)
                                 : gait(in_plane(model, particle.residual[kHeading]));
}

Outcome draw_first_noise(const MotionContext& context, WalkerParticle& particle, Rng& rng) {
  particle.first_frame = true;
  particle.way = {particle.aim.speed, 0};
  return predict(context, particle, rng) ? Outcome::kAlive : Outcome::kDead;
}

void propagate(const MotionContext& context, std::span<WalkerParticle> particles,
               std::span<Rng> rngs, std::span<Outcome> outcomes) {
  const bool turn = turns(context.model);
  for (size_t i = 0; i < particles.size(); ++i) {
    WalkerParticle& p = particles[i];
    const bool came = std::exchange(p.first_frame, false);
    if (turn && !came) update_travel_velocity(context, p);
    p.continuation = context.moves.jump_phase(context, p, rngs[i]) ? Continuation::kJumped
                                                                   : Continuation::kSimulated;
    predict_residuals(context, p);
    if (turn) relax_heading_to_travel(context, p);
  }
  context.moves.predict(context, particles, rngs, outcomes);
  for (size_t i = 0; i < particles.size(); ++i) {
    particles[i].pose_before = particles[i].pose;
    if (outcomes[i] != Outcome::kAlive) particles[i].continuation = Continuation::kCaught;
    if (!predict(context, particles[i], rngs[i])) outcomes[i] = Outcome::kDead;
  }
}

Outcome propagate(const MotionContext& context, WalkerParticle& particle, Rng& rng) {
  Outcome outcome;
  propagate(context, {&particle, 1}, {&rng, 1}, {&outcome, 1});
  return outcome;
}

void perturb(const MotionContext& context, double step_size, WalkerParticle& particle, Rng& rng) {
  // A quarter of the proposals change everything slightly, the others one part of the body.
  const double keep = std::sqrt(1 - step_size * step_size);
  const auto change = [&](int k) {
    double& z = particle.noise[static_cast<size_t>(k)];
    z = keep * z + step_size * rng.normal();
  };
  if (rng.uniform() < 0.25) {
    for (int k = 0; k < kResidualNoise; ++k) change(k);
    for (const ResidualAngle residual : free_residuals(context.model)) change(noise_of(residual));
  } else {
    const std::span<const NoiseGroup> groups = context.moves.noise_groups(context.model.path);
    constexpr size_t kArms = 2;
    const size_t count = groups.size() - (context.model.body.groups.arms ? 0 : kArms);
    const size_t chosen = static_cast<size_t>(rng.uniform() * static_cast<double>(count));
    for (const int k : groups[chosen]) change(k);
  }
  context.moves.apply_noise(context, particle);
}

}  // namespace tracker
}  // namespace walktrack
