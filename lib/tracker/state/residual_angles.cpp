#include "tracker/state/residual_angles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace walktrack {
inline namespace tracker {

namespace {

// Angles in the walker's plane that residual angles refer to, rad.
ResidualAngles planar_angles(const Pose& pose) {
  ResidualAngles out{};
  out[kTilt] = pose.tilt;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const LegPose& leg = pose.legs[static_cast<size_t>(side)];
    const double thigh = pose.tilt - leg.hip_flexion;
    out[of_side(kThigh, side)] = thigh;
    out[of_side(kShank, side)] = thigh + leg.knee_flexion;
  }
  return out;
}

ResidualAngles planar_angles(const Vector5& q, Side stance) {
  const Side swing = other(stance);
  ResidualAngles out{};
  out[kTilt] = q[kTorso];
  out[of_side(kThigh, stance)] = q[kStanceThigh];
  out[of_side(kThigh, swing)] = q[kSwingThigh];
  out[of_side(kShank, stance)] = q[kStanceShank];
  out[of_side(kShank, swing)] = q[kSwingShank];
  return out;
}

}  // namespace

double residual_energy(const MotionContext& context, const ResidualAngles& residual) {
  double sum = 0;
  for (const ResidualAngle k : kDeviations) {
    const MarkovConstants& c = row_of(k).process;
    if (residual[k] < c.lowest || residual[k] > c.highest)
      return std::numeric_limits<double>::infinity();
    const double off = residual[k] / (context.config.residual_scale * c.spread);
    sum += 0.5 * off * off;
  }
  return sum;
}

void fit_residuals_to(const Pose& pose, WalkerParticle& proposal) {
  ResidualAngles& residual = proposal.residual;
  for (const ResidualAngle k : kDeviations) residual[k] = 0;
  const KneedState shown = shown_state(proposal.walker, proposal.stance, proposal.aim, residual);
  const ResidualAngles wanted = planar_angles(pose),
                       there = planar_angles(shown.q, proposal.stance);
  for (const ResidualAngle k : kDeviations) residual[k] = wanted[k] - there[k];
}

// The process of tracker/motion/propagate.h is autoregressive with the double root r.
void draw_residuals_before(const MotionContext& context, WalkerParticle& proposal, Rng& rng) {
  for (const ResidualAngle k : kDeviations) {
    const MarkovConstants& c = row_of(k).process;
    const double rr = std::exp(-2 * context.dt / c.time);
    const double correlation = 2 * std::sqrt(rr) / (1 + rr), rest = (1 - rr) / (1 + rr);
    proposal.residual_before[k] =
        correlation * proposal.residual[k] +
        rest * context.config.residual_scale * c.spread * rng.truncated_normal(4);
  }
}

void stand_under(const BodyModel& model, const Pose& pose, WalkerParticle& proposal) {
  const Pose unplaced = pose_of(model, proposal.walker, proposal.stance, proposal.aim,
                                Eigen::Vector2d::Zero(), proposal.residual);
  proposal.ball = (pose.root - unplaced.root).head<2>();
}

bool try_proposal(const MotionContext& context, WalkerParticle proposal, WalkerParticle& particle,
                  Rng& rng) {
  fit_residuals_to(particle.pose, proposal);
  const double gain =
      residual_energy(context, particle.residual) - residual_energy(context, proposal.residual);
  if (!(std::log(rng.uniform()) < gain)) return false;
  draw_residuals_before(context, proposal, rng);
  stand_under(context.model, particle.pose, proposal);
  particle = proposal;
  return true;
}

}  // namespace tracker
}  // namespace walktrack
