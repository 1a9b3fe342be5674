#include "tracker/motion/models/markov_motion.h"

#include <algorithm>
#include <cmath>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "tracker/motion/models/kneed_motion.h"
#include "tracker/motion/propagate.h"
#include "tracker/state/noise_groups.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Noise of the root's velocity, m/s per sqrt(s), along and across the heading: root mean square of
// its changes from frame to frame.
constexpr double kAlong = 0.5, kAcross = 0.3;

constexpr std::array<NoiseGroup, 5> groups_of(const BodyNoise& body) {
  return {body.trunk, body.left_leg, body.right_leg, body.left_arm, body.right_arm};
}
constexpr std::array kMarkovGroups = groups_of(kSpatialNoise);
constexpr std::array kMarkovGroupsInPlane = groups_of(kSagittalNoise);

Pose pose_at(const Body& body, const ResidualAngles& residual, const Eigen::Vector2d& root) {
  Pose pose;
  pose.root << root, residual[kRootHeight];
  pose.heading = residual[kHeading];
  pose.list = residual[kList];
  pose.tilt = residual[kTilt];
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto of = [&](ResidualAngle left) { return residual[of_side(left, side)]; };
    pose.legs[static_cast<size_t>(side)] = {of(kHipFlexion), of(kAbduction), of(kRotation),
                                            std::max(0.0, of(kKneeFlexion)), of(kAnkle)};
  }
  if (body.groups.arms) pose.arms = arms_of(residual);
  return pose;
}

void set_angles(const Pose& pose, ResidualAngles& residual) {
  residual[kRootHeight] = pose.root.z();
  residual[kTilt] = pose.tilt;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const LegPose& leg = pose.legs[static_cast<size_t>(side)];
    residual[of_side(kHipFlexion, side)] = leg.hip_flexion;
    residual[of_side(kKneeFlexion, side)] = leg.knee_flexion;
  }
}

// How far a foot goes ahead of the root in a frame, m.
double foot_advance(const Body& body, const WalkerParticle& particle, Side side) {
  const Eigen::Vector3d ahead(std::cos(particle.pose.heading), std::sin(particle.pose.heading), 0);
  return ahead.dot(ankle_from_root(body, particle.pose, side) -
                   ankle_from_root(body, particle.pose_before, side));
}

}  // namespace

MarkovConstants free_constants(ResidualAngle residual) {
  const auto deg = [](double angle) { return rad_from_deg(angle); };
  switch (row_of(residual).left) {
    case kList:
      return {0, 0.3, deg(2.6), deg(-15), deg(15), 0.55};
    case kAbduction:
      return {0, 0.35, deg(6), deg(-20), deg(30), 0.9};
    case kRotation:
      return {deg(-5), 0.08, deg(6.4), deg(-40), deg(40)};
    case kAnkle:
      return {deg(-3), 0.2, deg(14), deg(-45), deg(30), 0.77};
    case kPace:
      return {0, 1, 0, 0, 0};
    case kRootHeight:
      return {0.96, 1.4, 0.025, 0.3, 1.2, 0.65};
    case kTilt:
      return {0, 0.25, deg(6), deg(-20), deg(40)};
    case kHipFlexion:
      return {deg(11), 0.7, deg(16.5), deg(-45), deg(110), 0.96};
    case kKneeFlexion:
      return {deg(30), 0.95, deg(21), 0, deg(150), 0.61};
    default:
      return row_of(residual).process;
  }
}

void enter_figure(const MotionContext& context, double phase, WalkerParticle& particle) {
  const PriorGait gait = aimed_gait(context, particle);
  // If the step has only begun, the pose a frame ago is the pose a frame later, mirrored in time.
  const double frame = context.dt / gait.period;
  const double sign = phase < frame ? -1 : 1;
  set_angles(pose_in_gait(context.model, gait, particle.stance, phase), particle.residual);
  set_angles(pose_in_gait(context.model, gait, particle.stance, phase - sign * frame),
             particle.residual_before);
  for (size_t k = 0; sign < 0 && k < particle.residual.size(); ++k)
    particle.residual_before[k] = 2 * particle.residual[k] - particle.residual_before[k];
}

void keep_rates(const ResidualAngles& now, const ResidualAngles& before, WalkerParticle& particle) {
  for (size_t k = 0; k < now.size(); ++k)
    particle.residual_before[k] = particle.residual[k] - (now[k] - before[k]);
}

MarkovConstants MarkovMotion::constants(const MotionConfig& config, ResidualAngle residual) const {
  MarkovConstants c = free_constants(residual);
  c.spread *= config.markov_noise_scale;
  if (residual != kRootHeight) return c;
  return {leg_ * c.rest, c.time, leg_ * c.spread, leg_ * c.lowest, leg_ * c.highest, c.period};
}

// The root's height, in metres, takes the place of an angle. Its spread is larger at the start than
// later, because the first figure is that of the gait and not yet that of the subject.
double MarkovMotion::start_spread(const MotionConfig& config, ResidualAngle residual) const {
  constexpr double kHeight = 0.058;  // of the leg's length; by hand, 5 cm of an adult
  return residual == kRootHeight ? kHeight * leg_ : MotionModel::start_spread(config, residual);
}

void MarkovMotion::initialise(const MotionContext& context, std::span<const double> phases,
                              std::span<WalkerParticle> particles) const {
  for (size_t i = 0; i < particles.size(); ++i) {
    enter_figure(context, phases[i], particles[i]);
    particles[i].velocity_per_impulse.setZero();
  }
}

void MarkovMotion::predict(const MotionContext& context, std::span<WalkerParticle> particles,
                           std::span<Rng>, std::span<Outcome> outcomes) const {
  std::fill(outcomes.begin(), outcomes.end(), Outcome::kAlive);
  for (WalkerParticle& p : particles) {
    const Eigen::Vector3d moved = p.pose.root - p.pose_before.root;
    p.ball = (p.pose.root + moved).head<2>();
    // The stance foot is the one that moves backwards under the root, as far as the last frame
    // shows.
    const Body& body = context.model.body;
    const bool left = foot_advance(body, p, Side::kLeft) < foot_advance(body, p, Side::kRight);
    const Side stance = left ? Side::kLeft : Side::kRight;
    p.walker.since_transfer = stance == p.stance ? p.walker.since_transfer + context.dt : 0;
    p.stance = stance;
  }
}

bool MarkovMotion::linearise_noise(const MotionContext& context, WalkerParticle& particle) const {
  const double change = context.config.markov_noise_scale * context.dt * std::sqrt(context.dt);
  particle.ball_sigma = change * Eigen::Vector2d(kAlong, kAcross);
  if (particle.first_frame) particle.ball_sigma.setConstant(context.config.start_position_sd);
  return true;
}

void MarkovMotion::apply_noise(const MotionContext& context, WalkerParticle& particle) const {
  const ResidualAngles now = particle.residual, before = particle.residual_before;
  realise_walker(context.model, context.scale, particle);
  const Body& body = context.model.body;
  particle.pose = pose_at(body, particle.residual, particle.ball);
  if (!particle.first_frame) return;
  // The subject is walking already when first seen.
  keep_rates(now, before, particle);
  const double heading = particle.residual[kHeading];
  const Eigen::Vector2d way =
      particle.aim.speed * context.dt * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  particle.pose_before = pose_at(body, particle.residual_before, particle.ball - way);
}

std::span<const NoiseGroup> MarkovMotion::noise_groups(Path path) const {
  return path == Path::kSpatial ? kMarkovGroups : kMarkovGroupsInPlane;
}

}  // namespace tracker
}  // namespace walktrack
