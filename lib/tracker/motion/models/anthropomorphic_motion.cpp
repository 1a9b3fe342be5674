#include "tracker/motion/models/anthropomorphic_motion.h"

#include <algorithm>
#include <cmath>

#include "core/anthropometry.h"
#include "core/conventions.h"
#include "tracker/motion/models/kneed_motion.h"
#include "tracker/motion/models/markov_motion.h"
#include "tracker/motion/support.h"
#include "tracker/state/noise_groups.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Of its five torques only those of the hip and of the ground under the stance foot act on the
// walker.
constexpr int kHipTorque = 1, kGroundTorque = 4;
constexpr std::array<int, 3> kTorques{kTorqueNoise + kHipTorque, kTorqueNoise + kGroundTorque,
                                      noise_of(kPace)};
constexpr std::array kLinkageGroups = groups_with(kSpatialNoise, kTorques);
constexpr std::array kLinkageGroupsInPlane = groups_with(kSagittalNoise, kTorques);

StraightState straight(const KneedState& walker) {
  return {{walker.q[kStanceThigh], walker.q[kSwingThigh]},
          {walker.qd[kStanceThigh], walker.qd[kSwingThigh]},
          walker.contact_x,
          walker.since_transfer,
          walker.transfers};
}

// The generalised torques of all five angles from those of two legs.
Vector5 spread_out(const Vector2& legs) {
  Vector5 out = Vector5::Zero();
  out[kStanceThigh] = out[kStanceShank] = legs[0];
  out[kSwingThigh] = out[kSwingShank] = legs[1];
  return out;
}

void set(const StraightState& state, KneedState& walker) {
  walker.q = spread_out(state.q);
  walker.qd = spread_out(state.qd);
  walker.contact_x = state.contact_x;
  walker.since_transfer = state.since_transfer;
  walker.transfers = state.transfers;
}

StraightControls straight(const KneedControls& controls) {
  return {controls.hip.stiffness, controls.toe_off_impulse};
}

void set(const StraightControls& straight, KneedControls& controls) {
  controls = {};
  controls.hip.stiffness = straight.stiffness;
  controls.toe_off_impulse = straight.toe_off_impulse;
}

// The walker with a trunk, and with knees flexed about the lines of its legs: thigh and shank have
// nearly equal lengths.
KneedState shown_state(const KneedState& walker, Side stance, const ResidualAngles& residual) {
  constexpr double kDeepestBend = anthropometry::kDeepestKneeBendDeg * kPi / 180;  // rad
  KneedState shown = walker;
  shown.q[kTorso] = residual[kTilt];
  const auto bend = [&](Side side, int thigh, int shank) {
    const double flexion = std::clamp(residual[of_side(kKneeFlexion, side)], 0.0, kDeepestBend);
    const double leg = residual[of_side(kThigh, side)];
    shown.q[thigh] += leg - 0.5 * flexion;
    shown.q[shank] += leg + 0.5 * flexion;
  };
  bend(stance, kStanceThigh, kStanceShank);
  bend(other(stance), kSwingThigh, kSwingShank);
  return shown;
}

}  // namespace

AnthropomorphicMotion::AnthropomorphicMotion(const BodyModel& model)
    : parameters_(straight_walker(walker_units(model.walker.parameters))),
      level_(straight_model(parameters_)),
      prior_(load_straight_prior()) {}

MarkovConstants AnthropomorphicMotion::constants(const MotionConfig& config,
                                                 ResidualAngle residual) const {
  switch (row_of(residual).left) {
    case kCrouch:
      return {0, 1, 0, 0, 0};  // knees do not act on the walker
    case kThigh:
      return {0, 0.15, config.residual_scale * rad_from_deg(8), rad_from_deg(-30),
              rad_from_deg(30)};
    case kTilt:
    case kAnkle:
    case kKneeFlexion:
      return free_constants(residual);
    default:
      return row_of(residual).process;
  }
}

void AnthropomorphicMotion::initialise(const MotionContext& context, std::span<const double> phases,
                                       std::span<WalkerParticle> particles) const {
  for (size_t i = 0; i < particles.size(); ++i) {
    WalkerParticle& p = particles[i];
    enter_figure(context, phases[i], p);
    for (ResidualAngles* residual : {&p.residual, &p.residual_before})
      (*residual)[kCrouch] = (*residual)[kThigh] = (*residual)[kThighRight] = 0;
    const StraightGait gait = aimed_gait(context.model, p);
    p.aim = {gait.speed, gait.step_length};
    set(gait.controls, p.controls);
    set(state_in_gait(context.model, gait, phases[i]), p.walker);
    p.predicted = p.walker;
    p.velocity_per_impulse.setZero();
  }
}

void AnthropomorphicMotion::predict(const MotionContext& context,
                                    std::span<WalkerParticle> particles, std::span<Rng> rngs,
                                    std::span<Outcome> outcomes) const {
  for (size_t i = 0; i < particles.size(); ++i) outcomes[i] = walk(context, particles[i], rngs[i]);
}

Outcome AnthropomorphicMotion::walk(const MotionContext& context, WalkerParticle& particle,
                                    Rng& rng) const {
  const StraightModel model =
      model_on(context.model, gravity_along(context.model, particle.residual[kHeading]));
  const double phase_error =
      context.config.phase_noise * std::sqrt(context.dt) * rng.truncated_normal(3);
  double left = std::max(0.0, context.dt * std::exp(particle.residual_before[kPace]) + phase_error);
  while (left > 0) {
    StraightState state = straight(particle.walker);
    const StraightAdvance done =
        straight_advance(model, straight(particle.controls), Vector2::Zero(), state, left);
    set(state, particle.walker);
    left -= done.elapsed;
    switch (done.event) {
      case KneedEvent::kNone:
        return Outcome::kAlive;
      case KneedEvent::kTransfer:
        change_support(context, particle, rng);
        break;
      case KneedEvent::kFallen:
        catch_step(context.model, particle);
        return Outcome::kFallen;
      case KneedEvent::kDiverged:
        catch_step(context.model, particle);
        return Outcome::kDiverged;
    }
  }
  return Outcome::kAlive;
}

void AnthropomorphicMotion::change_support(const MotionContext& context, WalkerParticle& particle,
                                           Rng& rng) const {
  change_feet(context.model,
              shown_state(particle.walker, other(particle.stance), particle.residual), particle);
  const MotionConfig& config = context.config;
  perturb_step_target(config, particle.aim, rng);
  const StraightGait gait = aimed_gait(context.model, particle);
  particle.aim = {gait.speed, gait.step_length};  // within the table
  set(draw_controls(rng, next_controls(gait, straight(particle.walker), config.feedback),
                    {.relative = config.control_noise, .rest = 0, .torque = 0}),
      particle.controls);
}

// A walker that stumbles continues with the state of its intended gait at the moment of the step at
// which the hips are where they are now.
void AnthropomorphicMotion::catch_step(const BodyModel& model, WalkerParticle& particle) const {
  const StraightGait gait = aimed_gait(model, particle);
  const auto hips = [&]() -> Eigen::Vector2d {
    const Pose pose = pose_showing(
        model, shown_state(particle.walker, particle.stance, particle.residual),
        particle.walker.q[kStanceShank], particle.stance, particle.ball, particle.residual);
    return pose.root.head<2>();
  };
  const Eigen::Vector2d now = hips();
  set(gait.controls, particle.controls);
  set(gait.start, particle.walker);
  const double phase = phase_of_hips(now - hips(), gait.step_length, particle);
  set(state_in_gait(model, gait, phase), particle.walker);
  particle.ball += now - hips();
}

StraightGait AnthropomorphicMotion::aimed_gait(const BodyModel& model,
                                               const WalkerParticle& particle) const {
  StraightLeggedParameters parameters = parameters_;
  if (!model.downhill.isZero())
    parameters.slope = in_plane(model, particle.residual[kHeading]).parameters.slope;
  return gait_at(prior_, parameters, particle.aim.speed, particle.aim.step_length);
}

StraightState AnthropomorphicMotion::state_in_gait(const BodyModel& model, const StraightGait& gait,
                                                   double phase) const {
  return state_at_phase(model_on(model, on_slope(model, gait.slope).gravity.x()), gait, phase);
}

StraightModel AnthropomorphicMotion::model_on(const BodyModel& model, double gravity_x) const {
  StraightModel out = level_;
  out.gravity_x = gravity_x;
  out.gravity_z = model.walker.gravity.y();
  return out;
}

bool AnthropomorphicMotion::linearise_noise(const MotionContext& context,
                                            WalkerParticle& particle) const {
  const StraightState state = straight(particle.walker);
  const auto rates = [&](double stance, double swing) {
    return straight_accelerations(level_, 0, Vector2(stance, swing), state);
  };
  const Vector2 still = rates(0, 0);
  particle.velocity_per_impulse.setZero();
  particle.velocity_per_impulse.col(kHipTorque) = spread_out(rates(-1, 1) - still);
  particle.velocity_per_impulse.col(kGroundTorque) = spread_out(rates(1, 0) - still);
  particle.ball_sigma = foot_sigma(context, particle);
  return particle.velocity_per_impulse.allFinite();
}

void AnthropomorphicMotion::apply_noise(const MotionContext& context,
                                        WalkerParticle& particle) const {
  const ResidualAngles now = particle.residual, before = particle.residual_before;
  realise_walker(context.model, context.scale, particle);
  if (particle.first_frame) keep_rates(now, before, particle);
  particle.pose = pose_showing(
      context.model, shown_state(particle.walker, particle.stance, particle.residual),
      particle.walker.q[kStanceShank], particle.stance, particle.ball, particle.residual);
}

std::span<const NoiseGroup> AnthropomorphicMotion::noise_groups(Path path) const {
  return path == Path::kSpatial ? kLinkageGroups : kLinkageGroupsInPlane;
}

}  // namespace tracker
}  // namespace walktrack
