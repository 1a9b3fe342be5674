#include "tracker/motion/models/kneed_motion.h"

#include <vector>

#include <Eigen/Cholesky>

#include "core/conventions.h"
#include "tracker/motion/models/walk_on.h"
#include "tracker/motion/standing.h"
#include "tracker/motion/support.h"
#include "tracker/moves/phase_jump.h"
#include "tracker/state/noise_groups.h"
#include "walker/kneed/kneed_batch.h"

namespace walktrack {
inline namespace tracker {

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

// Sets the first moment of the gait at which the particle aims, and its controls. Returns the time
// to the `phase` of its step, s.
double enter_gait(const MotionContext& context, double phase, WalkerParticle& particle) {
  const PriorGait gait = aimed_gait(context, particle);
  particle.aim = {gait.speed, gait.step_length};
  particle.controls = gait.controls;
  particle.walker = gait.start;
  if (gait.slope == 0) return phase * gait.period;  // simulated together with all others
  particle.walker = state_in_gait(context.model, gait, phase);
  return 0;
}

// Simulates every walker to its own moment, all in one batch, because a step takes as long to
// simulate as many frames.
void walk_to(const KneedModel& model, std::span<const double> times,
             std::span<WalkerParticle> particles) {
  std::vector<KneedState> states;
  std::vector<KneedControls> controls;
  for (const WalkerParticle& p : particles) {
    states.push_back(p.walker);
    controls.push_back(p.controls);
  }
  const std::vector<Vector5> noise(states.size(), Vector5::Zero());
  std::vector<KneedAdvance> done(states.size());
  kneed_advance_batch(model, controls, noise, times, states, done);
  for (size_t i = 0; i < states.size(); ++i) {
    particles[i].walker = particles[i].predicted = states[i];
    particles[i].velocity_per_impulse.setZero();
  }
}

constexpr std::array kKneedGroups = groups_with(kSpatialNoise, kWalkerNoise);
constexpr std::array kKneedGroupsInPlane = groups_with(kSagittalNoise, kWalkerNoise);

}  // namespace

KneedState state_in_gait(const BodyModel& model, const PriorGait& gait, double phase) {
  return gait.slope == 0 ? state_at_phase(model.walker, gait, phase)
                         : state_at_phase(on_slope(model, gait.slope), gait, phase);
}

Pose pose_in_gait(const BodyModel& model, const PriorGait& gait, Side stance, double phase) {
  ResidualAngles residual{};
  for (const ResidualAngle k : kAllResiduals) residual[k] = row_of(k).process.rest;
  Pose pose = pose_of(model, state_in_gait(model, gait, phase), stance,
                      {gait.speed, gait.step_length}, Eigen::Vector2d::Zero(), residual);
  pose.root.head<2>().setZero();
  return pose;
}

MarkovConstants KneedMotion::constants(const MotionConfig& config, ResidualAngle residual) const {
  const ResidualRow& row = row_of(residual);
  MarkovConstants c = row.process;
  if (row.is_deviation) c.spread *= config.residual_scale;
  return c;
}

void KneedMotion::initialise(const MotionContext& context, std::span<const double> phases,
                             std::span<WalkerParticle> particles) const {
  std::vector<double> times;
  for (size_t i = 0; i < particles.size(); ++i)
    times.push_back(enter_gait(context, phases[i], particles[i]));
  walk_to(context.model.walker, times, particles);
}

bool KneedMotion::jump_phase(const MotionContext& context, WalkerParticle& particle,
                             Rng& rng) const {
  if (context.standing != nullptr && change_regime(context, steps_, particle, rng)) return true;
  if (particle.regime == Regime::kStanding) return false;
  return rng.uniform() < context.config.phase_jump_rate * context.dt &&
         try_phase_jump(context, steps_, particle, rng);
}

void KneedMotion::predict(const MotionContext& context, std::span<WalkerParticle> particles,
                          std::span<Rng> rngs, std::span<Outcome> outcomes) const {
  walk_on(context, particles, rngs, outcomes);
}

bool KneedMotion::linearise_noise(const MotionContext& context, WalkerParticle& particle) const {
  if (particle.regime == Regime::kStanding) {
    particle.velocity_per_impulse.setZero();
    particle.ball_sigma = foot_sigma(context, particle);
    return true;
  }
  const Matrix5 mass = kneed_mass_matrix(context.model.walker, particle.walker.q);
  particle.velocity_per_impulse = mass.llt().solve(torque_distribution());
  particle.ball_sigma = foot_sigma(context, particle);
  return particle.velocity_per_impulse.allFinite();
}

void KneedMotion::apply_noise(const MotionContext& context, WalkerParticle& particle) const {
  // The first position is as uncertain for a standing subject as for a walking one.
  const bool stands = particle.regime == Regime::kStanding && !particle.first_frame;
  walktrack::apply_noise(context.model, stands ? context.standing->scale : context.scale, particle);
}

std::span<const NoiseGroup> KneedMotion::noise_groups(Path path) const {
  return path == Path::kSpatial ? kKneedGroups : kKneedGroupsInPlane;
}

}  // namespace tracker
}  // namespace walktrack
