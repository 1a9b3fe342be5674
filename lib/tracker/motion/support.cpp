#include "tracker/motion/support.h"

#include <algorithm>
#include <cmath>

#include "body/kinematics.h"

namespace walktrack {
inline namespace tracker {

Eigen::Vector2d foot_sigma(const MotionContext& context, const WalkerParticle& particle) {
  const MotionConfig& config = context.config;
  if (particle.first_frame) return Eigen::Vector2d::Constant(config.start_position_sd);
  const double root = std::sqrt(context.dt);
  if (particle.regime == Regime::kStanding)
    return Eigen::Vector2d::Constant(config.ball_slip * root);
  const double fresh =
      config.footfall_sd * std::exp(-particle.walker.since_transfer / config.footfall_decay);
  return {std::hypot(config.ball_drift * root, fresh), std::hypot(config.ball_slip * root, fresh)};
}

void change_feet(const BodyModel& model, const KneedState& shown, WalkerParticle& particle) {
  const Side landed = other(particle.stance);
  // The pose with the new roles of the legs at the old place, at which the leg that now swings is
  // still on the ground.
  particle.stance = landed;
  Pose pose = particle.pose;
  pose.tilt = shown.q[kTorso];
  const auto set = [&](Side side, int thigh, int shank) {
    LegPose& leg = pose.legs[static_cast<size_t>(side)];
    leg.hip_flexion = pose.tilt - shown.q[thigh];
    leg.knee_flexion = shown.q[shank] - shown.q[thigh];
  };
  set(landed, kStanceThigh, kStanceShank);
  set(other(landed), kSwingThigh, kSwingShank);
  stand_on(model.body, other(landed), Eigen::Vector3d(particle.ball.x(), particle.ball.y(), 0),
           rolled_ankle(model, particle.walker.q[kSwingShank]), pose);
  particle.ball = landing_ball(model, pose, landed, particle.walker.q[kStanceShank]);
}

double phase_of_hips(const Eigen::Vector2d& ahead, double step_length,
                     const WalkerParticle& particle) {
  constexpr double kLatest = 0.95;  // not about to strike; by hand
  const double heading = particle.residual[kHeading];
  const Eigen::Vector2d forward(std::cos(heading), std::sin(heading));
  return std::clamp(ahead.dot(forward) / step_length, 0.0, kLatest);
}

void perturb_step_target(const MotionConfig& config, StepAim& aim, Rng& rng) {
  aim.speed *= std::exp(config.aim_drift * rng.truncated_normal(3));
  aim.step_length *= std::exp(config.aim_drift * rng.truncated_normal(3));
}

}  // namespace tracker
}  // namespace walktrack
