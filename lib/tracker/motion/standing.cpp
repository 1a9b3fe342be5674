#include "tracker/motion/standing.h"

#include <algorithm>
#include <cmath>

namespace walktrack {
inline namespace tracker {

namespace {

// Rates at which standing particles propose to start walking and walking ones to stop, 1/s. By
// hand. With half or twice these rates, walks in the clips with people who stand begin and end at
// the same frames, within two frames.
constexpr double kSetsOff = 1, kStops = 0.5;

// Particles that start to walk aim at a usual walk, m/s for an adult, and are slower in the first
// half second. By hand.
constexpr double kSlowestAim = 0.6, kFastestAim = 1.3;
constexpr double kSlower = -0.25, kSlower_sd = 0.12;  // of kPace, a logarithm
// Moments of the step at which they begin: before the legs have passed each other. By hand.
constexpr double kLatest = 0.6;
// Steps that are tried for a particle that has to set off: two of five fit its pose.
constexpr int kTries = 5;

bool sets_off(const MotionContext& context, const StepLibrary& steps, WalkerParticle& particle,
              Rng& rng) {
  const double unit = std::sqrt(context.model.body.subject.height / kAdultHeight);
  const double leg = leg_length(context.model.body.lengths);
  const double speed = unit * (kSlowestAim + (kFastestAim - kSlowestAim) * rng.uniform());
  const double pace = std::sqrt(context.model.walker.parameters.gravity * leg);
  const StepAim aim{speed, leg * preferred_step_length(speed / pace)};
  const LibraryStep* step = steps.near(aim, particle.residual[kHeading], rng);
  if (step == nullptr) return false;
  WalkerParticle proposal = particle;
  proposal.regime = Regime::kWalking;
  proposal.aim = step->aim;
  proposal.controls = step->controls;
  proposal.walker =
      step->moments[static_cast<size_t>(rng.uniform() * kLatest * double{LibraryStep::kMoments})];
  if (rng.uniform() < 0.5) proposal.stance = other(particle.stance);
  fit_residuals_to(particle.pose, proposal);
  if (!std::isfinite(residual_energy(context, proposal.residual))) return false;
  draw_residuals_before(context, proposal, rng);
  const MarkovConstants& c = row_of(kPace).process;
  proposal.residual[kPace] =
      std::clamp(kSlower + kSlower_sd * rng.truncated_normal(3), c.lowest, c.highest);
  proposal.residual_before[kPace] = proposal.residual[kPace];
  stand_under(context.model, particle.pose, proposal);
  particle = proposal;
  return true;
}

bool stops(const MotionContext& context, WalkerParticle& particle, Rng& rng) {
  WalkerParticle proposal = particle;
  stand(proposal);
  return try_proposal(context, proposal, particle,
                      rng);  // a particle whose pose is that of a walk continues to walk
}

}  // namespace

bool may_stand(const MotionConfig& config) {
  return config.standing && config.model == MotionKind::kKneed;
}

StandingProcess standing_process(const MotionModel& moves, const MotionConfig& config, double dt) {
  StandingProcess out;
  for (const ResidualAngle residual : kAllResiduals) {
    MarkovConstants c = moves.constants(config, residual);
    c.time = row_of(residual).standing_time;
    out.markov[residual] = markov_step(residual, c, dt);
    out.scale.residual[residual] = frame_noise(config, residual, c, dt);
  }
  out.scale.elapsed = dt;
  return out;
}

void stand(WalkerParticle& particle) {
  particle.regime = Regime::kStanding;
  particle.walker = {};
  particle.walker.stance_stop = particle.walker.swing_stop = true;
}

bool change_regime(const MotionContext& context, const StepLibrary& steps, WalkerParticle& particle,
                   Rng& rng) {
  if (particle.regime == Regime::kStanding && context.all_set_off) {
    for (int i = 0; i < kTries; ++i)
      if (sets_off(context, steps, particle, rng)) return true;
    return false;
  }
  if (particle.regime == Regime::kStanding)
    return rng.uniform() < kSetsOff * context.dt && sets_off(context, steps, particle, rng);
  return rng.uniform() < kStops * context.dt && stops(context, particle, rng);
}

}  // namespace tracker
}  // namespace walktrack
