#include "tracker/moves/rephase.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tracker/motion/kneed_motion.h"

namespace walktrack {

namespace {

// Angles in the walker's plane in the order of the extras from kTilt on: trunk, thighs, shanks,
// rad.
constexpr size_t kStrays = kShankRight - kTilt + 1;
using PlanarAngles = Eigen::Array<double, kStrays, 1>;

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

// -log of the strays' density, but for a constant; infinite beyond their limits.
double improbability(const MotionContext& context, const Extras& extra) {
  double sum = 0;
  for (size_t k = kTilt; k < kTilt + kStrays; ++k) {
    const MarkovConstants c = markov_constants(static_cast<Extra>(k));
    if (extra[k] < c.lowest || extra[k] > c.highest) return std::numeric_limits<double>::infinity();
    const double off = extra[k] / (context.config.misfit * c.spread);
    sum += 0.5 * off * off;
  }
  return sum;
}

// The strays with which the walker of `reading` shows `pose`.
void explain(const Pose& pose, WalkerParticle& reading) {
  Extras& extra = reading.extra;
  std::fill_n(extra.begin() + kTilt, kStrays, 0.0);
  const KneedState shown = shown_state(reading.walker, reading.stance, reading.aim, extra);
  const PlanarAngles stray = planar_angles(pose) - planar_angles(shown.q, reading.stance);
  for (size_t k = 0; k < kStrays; ++k) extra[kTilt + k] = stray[static_cast<Eigen::Index>(k)];
}

// Strays of a frame ago, drawn as those of now let expect: the process of tracker/motion/motion.h
// is autoregressive with the double root r.
void draw_before(const MotionContext& context, WalkerParticle& reading, Rng& rng) {
  for (size_t k = kTilt; k < kTilt + kStrays; ++k) {
    const MarkovConstants c = markov_constants(static_cast<Extra>(k));
    const double rr = std::exp(-2 * context.dt / c.time);
    const double correlation = 2 * std::sqrt(rr) / (1 + rr), rest = (1 - rr) / (1 + rr);
    reading.extra_before[k] = correlation * reading.extra[k] +
                              rest * context.config.misfit * c.spread * rng.truncated_normal(4);
  }
}

}  // namespace

bool rephase(const MotionContext& context, const StepBook& steps, WalkerParticle& particle,
             Rng& rng) {
  const BookedStep* step = steps.near(particle.aim, particle.extra[kHeading], rng);
  if (step == nullptr) return false;
  WalkerParticle reading = particle;
  reading.aim = step->aim;
  reading.controls = step->controls;
  reading.walker = step->moments[static_cast<size_t>(rng.uniform() * BookedStep::kMoments)];
  if (rng.uniform() < 0.5) reading.stance = other(particle.stance);
  explain(particle.pose, reading);
  const double gain =
      improbability(context, particle.extra) - improbability(context, reading.extra);
  // Without a number, when both stray beyond limits or nothing may stray, the pose is kept as read.
  if (!(std::log(rng.uniform()) < gain)) return false;
  draw_before(context, reading, rng);
  const Pose unplaced = pose_of(context.model, reading.walker, reading.stance, reading.aim,
                                Eigen::Vector2d::Zero(), reading.extra);
  reading.ball = (particle.pose.root - unplaced.root).head<2>();
  particle = reading;
  return true;
}

}  // namespace walktrack
