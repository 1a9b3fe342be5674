#include "tracker/motion/residual_angles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tracker/motion/kneed_motion.h"

namespace walktrack {

namespace {

// Angles in the walker's plane in the order of the residuals, rad.
using PlanarAngles = Eigen::Array<double, kInPlaneCount, 1>;

PlanarAngles planar_angles(const Pose& pose) {
  PlanarAngles out;
  out[0] = pose.tilt;
  for (int i = 0; i < 2; ++i) {
    const LegPose& leg = pose.legs[static_cast<size_t>(i)];
    out[1 + i] = pose.tilt - leg.hip_flexion;
    out[3 + i] = out[1 + i] + leg.knee_flexion;
  }
  return out;
}

PlanarAngles planar_angles(const Vector5& q, Side stance) {
  const int standing = static_cast<int>(stance), swinging = 1 - standing;
  PlanarAngles out;
  out[0] = q[kTorso];
  out[1 + standing] = q[kStanceThigh];
  out[1 + swinging] = q[kSwingThigh];
  out[3 + standing] = q[kStanceShank];
  out[3 + swinging] = q[kSwingShank];
  return out;
}

}  // namespace

double residual_energy(const MotionContext& context, const ResidualAngles& residual) {
  double sum = 0;
  for (size_t k = kTilt; k < kTilt + kInPlaneCount; ++k) {
    const MarkovConstants c = markov_constants(static_cast<ResidualAngle>(k));
    if (residual[k] < c.lowest || residual[k] > c.highest)
      return std::numeric_limits<double>::infinity();
    const double off = residual[k] / (context.config.residual_scale * c.spread);
    sum += 0.5 * off * off;
  }
  return sum;
}

void fit_residuals_to(const Pose& pose, WalkerParticle& reading) {
  ResidualAngles& residual = reading.residual;
  std::fill_n(residual.begin() + kTilt, kInPlaneCount, 0.0);
  const KneedState shown = shown_state(reading.walker, reading.stance, reading.aim, residual);
  const PlanarAngles residual_now = planar_angles(pose) - planar_angles(shown.q, reading.stance);
  for (size_t k = 0; k < kInPlaneCount; ++k)
    residual[kTilt + k] = residual_now[static_cast<Eigen::Index>(k)];
}

// The process of tracker/motion/motion.h is autoregressive with the double root r.
void draw_residuals_before(const MotionContext& context, WalkerParticle& reading, Rng& rng) {
  for (size_t k = kTilt; k < kTilt + kInPlaneCount; ++k) {
    const MarkovConstants c = markov_constants(static_cast<ResidualAngle>(k));
    const double rr = std::exp(-2 * context.dt / c.time);
    const double correlation = 2 * std::sqrt(rr) / (1 + rr), rest = (1 - rr) / (1 + rr);
    reading.residual_before[k] =
        correlation * reading.residual[k] +
        rest * context.config.residual_scale * c.spread * rng.truncated_normal(4);
  }
}

void stand_under(const BodyModel& model, const Pose& pose, WalkerParticle& reading) {
  const Pose unplaced = pose_of(model, reading.walker, reading.stance, reading.aim,
                                Eigen::Vector2d::Zero(), reading.residual);
  reading.ball = (pose.root - unplaced.root).head<2>();
}

bool try_reading(const MotionContext& context, WalkerParticle reading, WalkerParticle& particle,
                 Rng& rng) {
  fit_residuals_to(particle.pose, reading);
  const double gain =
      residual_energy(context, particle.residual) - residual_energy(context, reading.residual);
  if (!(std::log(rng.uniform()) < gain)) return false;
  draw_residuals_before(context, reading, rng);
  stand_under(context.model, particle.pose, reading);
  particle = reading;
  return true;
}

}  // namespace walktrack
