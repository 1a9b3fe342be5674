#include "tracker/state/particle.h"

#include <algorithm>
#include <cmath>

#include "body/kinematics.h"
#include "core/anthropometry.h"
#include "core/conventions.h"
#include "tracker/motion/stride.h"

namespace walktrack {
inline namespace tracker {

namespace {

// As many as the prior has (gait/prior/build_prior.h).
constexpr int kTableSlopes = 5;

size_t index(Side side) { return static_cast<size_t>(side); }

// Knees do not bend backwards, nor further than until the heel meets the thigh: at these limits the
// shank follows the thigh.
void clamp_knees(KneedState& s) {
  constexpr double kDeepestBend = anthropometry::kDeepestKneeBendDeg * kPi / 180;  // rad
  const auto keep = [&](int shank, int thigh) {
    s.q[shank] = std::clamp(s.q[shank], s.q[thigh], s.q[thigh] + kDeepestBend);
  };
  keep(kStanceShank, kStanceThigh);
  keep(kSwingShank, kSwingThigh);
}

// A normal number with a heavier tail: people mostly walk straight ahead, but turns can be large.
double heavy_tailed(double normal) { return std::sinh(normal); }

void set_leg(const KneedState& s, bool stance, const ResidualAngles& residual, Side side,
             Pose& pose) {
  const double thigh = s.q[stance ? kStanceThigh : kSwingThigh];
  const double shank = s.q[stance ? kStanceShank : kSwingShank];
  pose.legs[index(side)] = {s.q[kTorso] - thigh, residual[of_side(kAbduction, side)],
                            residual[of_side(kRotation, side)], shank - thigh,
                            residual[of_side(kAnkle, side)]};
}

}  // namespace

std::array<ArmPose, 2> arms_of(const ResidualAngles& residual) {
  const auto arm = [&](Side side) -> ArmPose {
    return {residual[of_side(kShoulder, side)], residual[of_side(kShoulderAbduction, side)],
            residual[of_side(kElbow, side)]};
  };
  return {arm(Side::kLeft), arm(Side::kRight)};
}

KneedState shown_state(const KneedState& walker, Side stance, const StepAim& aim,
                       const ResidualAngles& residual) {
  const Side swing = other(stance);
  const double half_stride = 0.5 * std::min(1.0, walker.since_transfer / aim.duration());
  const LegDifference stands = leg_difference(half_stride);
  const LegDifference swings = leg_difference(0.5 + half_stride);
  // Thigh and shank have nearly equal lengths, so that the hip sinks straight down.
  const double crouch = 0.5 * residual[kCrouch];
  KneedState shown = walker;
  shown.q[kTorso] += residual[kTilt];
  shown.q[kStanceThigh] += stands.thigh + residual[of_side(kThigh, stance)] - crouch;
  shown.q[kStanceShank] += stands.shank + residual[of_side(kShank, stance)] + crouch;
  shown.q[kSwingThigh] += swings.thigh + residual[of_side(kThigh, swing)] - crouch;
  shown.q[kSwingShank] += swings.shank + residual[of_side(kShank, swing)] + crouch;
  clamp_knees(shown);
  return shown;
}

Pose pose_of(const BodyModel& model, const KneedState& walker, Side stance, const StepAim& aim,
             const Eigen::Vector2d& ball, const ResidualAngles& residual) {
  return pose_showing(model, shown_state(walker, stance, aim, residual), walker.q[kStanceShank],
                      stance, ball, residual);
}

Pose pose_showing(const BodyModel& model, const KneedState& shown, double shank, Side stance,
                  const Eigen::Vector2d& ball, const ResidualAngles& residual) {
  Pose pose;
  pose.heading = residual[kHeading];
  pose.list = residual[kList];
  pose.tilt = shown.q[kTorso];
  set_leg(shown, true, residual, stance, pose);
  set_leg(shown, false, residual, other(stance), pose);
  if (model.body.groups.arms) pose.arms = arms_of(residual);
  stand_on(model.body, stance, Eigen::Vector3d(ball.x(), ball.y(), 0), rolled_ankle(model, shank),
           pose);
  return pose;
}

void realise_walker(const BodyModel& model, const NoiseScale& scale, WalkerParticle& particle) {
  const auto& z = particle.noise;
  Vector5 impulse;
  for (int k = 0; k < 5; ++k) impulse[k] = scale.impulse[size_t(k)] * z[size_t(kTorqueNoise + k)];
  // A torque held through the frame moves the angle half as far as its final rate would.
  const Vector5 kick = particle.velocity_per_impulse * impulse;
  KneedState& walker = particle.walker;
  walker = particle.predicted;
  walker.qd += kick;
  walker.q += 0.5 * scale.elapsed * kick;
  clamp_knees(walker);
  particle.residual[kHeading] = particle.predicted_residual[kHeading];
  for (const size_t i : free_residuals(model)) {
    const double noise = z[size_t(kResidualNoise) + i];
    particle.residual[i] = particle.predicted_residual[i] +
                           scale.residual[i] * (i == kHeading ? heavy_tailed(noise) : noise);
  }
  if (particle.first_frame) particle.residual_before = particle.residual;
  const double heading = particle.residual[kHeading];
  const Eigen::Vector2d ahead(std::cos(heading), std::sin(heading));
  particle.ball =
      particle.predicted_ball + particle.ball_sigma.x() * z[kBallNoise] * ahead +
      particle.ball_sigma.y() * z[kBallNoise + 1] * Eigen::Vector2d(-ahead.y(), ahead.x());
}

void apply_noise(const BodyModel& model, const NoiseScale& scale, WalkerParticle& particle) {
  realise_walker(model, scale, particle);
  particle.pose = pose_of(model, particle.walker, particle.stance, particle.aim, particle.ball,
                          particle.residual);
}

Eigen::Vector2d rolled_ankle(const BodyModel& model, double shank) {
  const KneedParameters& p = model.walker.parameters;
  const double c = std::cos(shank), s = std::sin(shank);
  return {p.foot_radius * shank - p.foot_up * s - p.foot_forward * (c - 1) -
              model.body.lengths.ball_forward,
          p.foot_radius - p.foot_up * c + p.foot_forward * s};
}

Eigen::Vector2d landing_ball(const BodyModel& model, const Pose& pose, Side landed, double shank) {
  const Eigen::Vector3d ankle = pose.root + ankle_from_root(model.body, pose, landed);
  const double outward = landed == Side::kLeft ? 1 : -1;
  const double toes = pose.heading - outward * pose.legs[index(landed)].hip_rotation;
  return ankle.head<2>() -
         rolled_ankle(model, shank).x() * Eigen::Vector2d(std::cos(toes), std::sin(toes));
}

double gravity_along(const BodyModel& model, double heading) {
  return model.downhill.dot(Eigen::Vector2d(std::cos(heading), std::sin(heading)));
}

KneedModel in_plane(const BodyModel& model, double heading) {
  KneedModel out = model.walker;
  if (model.downhill.isZero()) return out;
  out.gravity.x() = gravity_along(model, heading);
  out.parameters.slope = std::atan2(out.gravity.x(), -out.gravity.y());
  return out;
}

KneedModel on_slope(const BodyModel& model, double slope) {
  KneedModel out = model.walker;
  if (slope == 0) return out;
  out.gravity.x() = -std::tan(slope) * out.gravity.y();
  out.parameters.slope = slope;
  return out;
}

std::vector<double> table_headings(const Eigen::Vector2d& downhill) {
  if (downhill.isZero()) return {0};
  const double down = std::atan2(downhill.y(), downhill.x());
  std::vector<double> headings;
  for (int i = 0; i < kTableSlopes; ++i)
    headings.push_back(down + std::acos(2.0 * i / (kTableSlopes - 1) - 1));
  return headings;
}

size_t table_heading(const Eigen::Vector2d& downhill, double heading) {
  if (downhill.isZero()) return 0;
  const Eigen::Vector2d ahead(std::cos(heading), std::sin(heading));
  const double share = std::clamp(downhill.normalized().dot(ahead), -1.0, 1.0);
  return static_cast<size_t>(std::lround((share + 1) / 2 * (kTableSlopes - 1)));
}

}  // namespace tracker
}  // namespace walktrack
