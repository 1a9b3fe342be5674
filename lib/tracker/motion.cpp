#include "tracker/motion.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/Cholesky>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "tracker/rephase.h"
#include "tracker/walk_on.h"

namespace walktrack {

namespace {

// Rows: q's coordinates; columns: torques between torso and stance thigh, hip, stance knee, swing
// knee, and of the ground on the stance shank.
// clang-format off
Matrix5 torque_distribution() {
  Matrix5 b;
  b <<  1,  0,  0,  0, 0,
       -1, -1, -1,  0, 0,
        0,  1,  0, -1, 0,
        0,  0,  1,  0, 1,
        0,  0,  0,  1, 0;
  return b;
}
// clang-format on

// Arms swing against the legs: forward with the other side's thigh.
double rest_of(Extra extra, const MarkovConstants& constants, const WalkerParticle& particle) {
  if (extra != kShoulder && extra != kShoulderRight) return constants.rest;
  constexpr double kArmPerLeg = 0.6;  // walking at 1.3 m/s, Murray et al. 1967
  const size_t other_leg = 1 - static_cast<size_t>(extra - kShoulder);
  return constants.rest + kArmPerLeg * particle.pose.legs[other_leg].hip_flexion;
}

void predict_extras(const MotionContext& context, WalkerParticle& particle) {
  for (int k = 0; k < extra_count(context.model.body); ++k) {
    const auto extra = static_cast<Extra>(k);
    const size_t i = static_cast<size_t>(k);
    const MarkovConstants c = markov_constants(extra);
    const double r = std::exp(-context.dt / c.time);
    const double a = k == kHeading ? r : r * r, b = k == kHeading ? 0 : (1 - r) * (1 - r);
    const double now = particle.extra[i];
    const double next =
        now + a * (now - particle.extra_before[i]) + b * (rest_of(extra, c, particle) - now);
    particle.extra_before[i] = now;
    particle.predicted_extra[i] = std::clamp(next, c.lowest, c.highest);
  }
}

void draw_noise(const MotionContext& context, WalkerParticle& particle, Rng& rng) {
  const int count = kExtraNoise + extra_count(context.model.body);
  for (int k = 0; k < count; ++k) particle.noise[static_cast<size_t>(k)] = rng.truncated_normal(4);
}

Eigen::Vector2d ball_sigma(const MotionContext& context, const WalkerParticle& particle) {
  const MotionConfig& config = context.config;
  if (particle.arriving) return Eigen::Vector2d::Constant(config.arrival);
  const double fresh = config.landing * std::exp(-particle.walker.since_transfer / config.settling);
  const double root = std::sqrt(context.dt);
  return {std::hypot(config.ball_drift * root, fresh), std::hypot(config.ball_slip * root, fresh)};
}

// The walker as it is becomes the frame's prediction, and its noise is drawn.
bool predict(const MotionContext& context, WalkerParticle& particle, Rng& rng) {
  const Matrix5 mass = kneed_mass_matrix(context.model.walker, particle.walker.q);
  particle.velocity_per_impulse = mass.llt().solve(torque_distribution());
  if (!particle.velocity_per_impulse.allFinite()) return false;
  particle.predicted = particle.walker;
  particle.predicted_ball = particle.ball;
  particle.ball_sigma = ball_sigma(context, particle);
  draw_noise(context, particle, rng);
  realise(context.model, context.scale, particle);
  return true;
}

// Noise that moves one part of the body: what the walker feels, the trunk with the standing foot,
// a leg, an arm.
constexpr size_t kNoiseGroups = 6, kNoiseGroupsWithoutArms = 4;
std::span<const int> noise_group(size_t group) {
  constexpr int e = kExtraNoise, t = kTorqueNoise, b = kBallNoise;
  static constexpr std::array<int, 6> walker{t, t + 1, t + 2, t + 3, t + 4, e + kPace};
  static constexpr std::array<int, 6> trunk{b,         b + 1,       e + kHeading,
                                            e + kList, e + kCrouch, e + kTilt};
  static constexpr std::array<int, 5> left{e + kAbduction, e + kRotation, e + kAnkle, e + kThigh,
                                           e + kShank};
  static constexpr std::array<int, 5> right{e + kAbductionRight, e + kRotationRight,
                                            e + kAnkleRight, e + kThighRight, e + kShankRight};
  static constexpr std::array<int, 3> left_arm{e + kShoulder, e + kShoulderAbduction, e + kElbow};
  static constexpr std::array<int, 3> right_arm{e + kShoulderRight, e + kShoulderAbductionRight,
                                                e + kElbowRight};
  switch (group) {
    case 0:
      return trunk;
    case 1:
      return left;
    case 2:
      return right;
    case 3:
      return walker;
    case 4:
      return left_arm;
    default:
      return right_arm;
  }
}

}  // namespace

MarkovConstants markov_constants(Extra extra) {
  const auto deg = [](double angle) { return rad_from_deg(angle); };
  switch (extra) {
    case kHeading:
      return {0, 0.5, 0.3, -1e9, 1e9};
    case kList:
      return {0, 0.15, deg(3), deg(-15), deg(15)};
    case kAbduction:
    case kAbductionRight:
      return {deg(-2.5), 0.15, deg(3.5), deg(-20), deg(30)};
    case kRotation:
    case kRotationRight:
      return {deg(-5), 0.2, deg(6), deg(-40), deg(40)};
    case kAnkle:
    case kAnkleRight:
      return {deg(-3), 0.08, deg(12), deg(-45), deg(30)};
    case kPace:
      return {0, 0.5, 0.12, -0.4, 0.4};
    case kCrouch:
      return {deg(8), 3, deg(3), deg(-10), deg(40)};
    case kTilt:
      return {0, 1, deg(9), deg(-20), deg(40)};
    case kThigh:
    case kThighRight:
      return {0, 0.15, deg(6), deg(-30), deg(30)};
    case kShank:
    case kShankRight:
      return {0, 0.12, deg(8), deg(-40), deg(40)};
    case kShoulder:
    case kShoulderRight:
      return {0, 0.2, deg(15), deg(-60), deg(120)};
    case kShoulderAbduction:
    case kShoulderAbductionRight:
      return {deg(6), 0.2, deg(6), deg(-10), deg(60)};
    case kElbow:
    case kElbowRight:
    case kExtraCount:
      break;
  }
  return {deg(22), 0.2, deg(15), 0, deg(130)};
}

MotionConfig to_scale(const MotionConfig& config, double height) {
  const double length = height / kAdultHeight, time = std::sqrt(length);
  MotionConfig scaled = config;
  scaled.torque_noise_scale *= std::sqrt(time);  // of a share of M g L per root second
  scaled.clock *= std::sqrt(time);
  scaled.turning /= time;
  scaled.ball_drift *= length / std::sqrt(time);
  scaled.ball_slip *= length / std::sqrt(time);
  scaled.landing *= length;
  scaled.settling *= time;
  scaled.arrival *= length;
  scaled.rephasing /= time;
  return scaled;
}

NoiseScale noise_scale(const MotionConfig& config, const BodyModel& model, double dt) {
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
  for (int k = 0; k < kExtraCount; ++k) {
    const MarkovConstants c = markov_constants(static_cast<Extra>(k));
    const double r = std::exp(-dt / c.time), rr = r * r;
    const bool strays = k >= kTilt && k <= kShankRight;
    scale.extra[static_cast<size_t>(k)] =
        k == kHeading ? config.turning * dt * std::sqrt(1 - rr)
                      : (strays ? config.misfit : 1) * c.spread *
                            std::sqrt((1 - rr) * (1 - rr) * (1 - rr) / (1 + rr));
  }
  return scale;
}

Outcome arrive(const MotionContext& context, WalkerParticle& particle, Rng& rng) {
  particle.arriving = true;
  return predict(context, particle, rng) ? Outcome::kAlive : Outcome::kDead;
}

void propagate(const MotionContext& context, std::span<WalkerParticle> particles,
               std::span<Rng> rngs, std::span<Outcome> outcomes) {
  for (size_t i = 0; i < particles.size(); ++i) {
    WalkerParticle& p = particles[i];
    p.arriving = false;
    if (rngs[i].uniform() < context.config.rephasing * context.dt) rephase(context, p, rngs[i]);
    predict_extras(context, p);
    p.pose_before = p.pose;
  }
  walk_on(context, particles, rngs, outcomes);
  for (size_t i = 0; i < particles.size(); ++i)
    if (!predict(context, particles[i], rngs[i])) outcomes[i] = Outcome::kDead;
}

Outcome propagate(const MotionContext& context, WalkerParticle& particle, Rng& rng) {
  Outcome outcome;
  propagate(context, {&particle, 1}, {&rng, 1}, {&outcome, 1});
  return outcome;
}

void perturb(const MotionContext& context, double boldness, WalkerParticle& particle, Rng& rng) {
  // A quarter of the proposals changes everything a little, the others one part of the body.
  const double keep = std::sqrt(1 - boldness * boldness);
  const auto change = [&](int k) {
    double& z = particle.noise[static_cast<size_t>(k)];
    z = keep * z + boldness * rng.normal();
  };
  if (rng.uniform() < 0.25) {
    const int count = kExtraNoise + extra_count(context.model.body);
    for (int k = 0; k < count; ++k) change(k);
  } else {
    const size_t groups = context.model.body.groups.arms ? kNoiseGroups : kNoiseGroupsWithoutArms;
    const size_t chosen = static_cast<size_t>(rng.uniform() * static_cast<double>(groups));
    for (const int k : noise_group(chosen)) change(k);
  }
  realise(context.model, context.scale, particle);
}

}  // namespace walktrack
