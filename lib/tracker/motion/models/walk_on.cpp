#include "tracker/motion/models/walk_on.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/scratch.h"
#include "tracker/motion/models/kneed_motion.h"
#include "tracker/motion/support.h"
#include "walker/kneed/kneed_batch.h"
#include "walker/kneed/kneed_stops.h"

namespace walktrack {
inline namespace tracker {

namespace {

// The longest steps of the prior lower the hip by a sixth. A walker whose hip is lower has been
// pushed to a pose in which its legs are hidden, and it will not recover.
constexpr KneedLimits kWalks{.min_hip_height = 0.8};

// The new step's controls start from the gait of its aim, corrected for the state that the strike
// has left.
void choose_controls(const MotionContext& context, WalkerParticle& particle, Rng& rng) {
  const MotionConfig& config = context.config;
  perturb_step_target(config, particle.aim, rng);
  const PriorGait gait = aimed_gait(context, particle);
  particle.aim = {gait.speed, gait.step_length};  // within the table
  particle.controls = draw_controls(
      rng, next_controls(gait, particle.walker, config.feedback),
      {.relative = config.control_noise, .rest = 0.5 * config.control_noise, .torque = 0});
}

// The swing foot has landed: it becomes the supporting foot, and a new step begins.
void change_support(const MotionContext& context, WalkerParticle& particle, Rng& rng) {
  change_feet(context.model,
              shown_state(particle.walker, other(particle.stance), particle.aim, particle.residual),
              particle);
  choose_controls(context, particle, rng);
}

// A walker that stumbles continues with the state of its intended gait at the moment of the step at
// which the hips are where they are now.
void catch_step(const MotionContext& context, WalkerParticle& particle) {
  const PriorGait gait = aimed_gait(context, particle);
  const auto hips = [&](const KneedState& walker) -> Eigen::Vector2d {
    const Pose pose = pose_of(context.model, walker, particle.stance, particle.aim, particle.ball,
                              particle.residual);
    return pose.root.head<2>();
  };
  const Eigen::Vector2d now = hips(particle.walker);
  const double phase = phase_of_hips(now - hips(gait.start), gait.step_length, particle);
  particle.controls = gait.controls;
  particle.walker = state_in_gait(context.model, gait, phase);
  particle.ball += now - hips(particle.walker);
}

// The inputs of the batch kernel for a group of particles.
struct Group {
  std::pmr::vector<KneedState> states;
  std::pmr::vector<KneedControls> controls;
  std::pmr::vector<Vector5> noise;
  std::pmr::vector<double> left;  // s of the frame that are left; 0 = at its end
  std::pmr::vector<KneedAdvance> done;

  Group(size_t count, std::pmr::memory_resource* memory)
      : states(memory),
        controls(memory),
        noise(count, Vector5::Zero(), memory),
        left(memory),
        done(count, memory) {
    states.reserve(count);
    controls.reserve(count);
    left.reserve(count);
  }
};

void gather(const MotionContext& context, std::span<WalkerParticle> particles, std::span<Rng> rngs,
            Group& group) {
  for (size_t i = 0; i < particles.size(); ++i) {
    WalkerParticle& p = particles[i];
    if (p.regime == Regime::kStanding) {
      group.states.push_back(p.walker);
      group.controls.push_back(p.controls);
      group.left.push_back(0);
      continue;
    }
    settle_knee_stops(in_plane(context.model, p.residual[kHeading]), p.controls, Vector5::Zero(),
                      p.walker);
    group.states.push_back(p.walker);
    group.controls.push_back(p.controls);
    const double phase_error =
        context.config.phase_noise * std::sqrt(context.dt) * rngs[i].truncated_normal(3);
    const double time = context.dt * std::exp(p.residual_before[kPace]) + phase_error;
    group.left.push_back(std::max(0.0, time));
  }
}

// Simulates all walkers to the end of their time or to the next event. On a slope gravity depends
// on the heading, so that every particle has a model of its own there.
void advance(const MotionContext& context, std::span<const WalkerParticle> particles,
             Group& group) {
  if (context.model.downhill.isZero())
    return kneed_advance_batch(context.model.walker, group.controls, group.noise, group.left,
                               group.states, group.done, kWalks);
  for (size_t i = 0; i < particles.size(); ++i)
    if (group.left[i] > 0)
      group.done[i] =
          kneed_advance(in_plane(context.model, particles[i].residual[kHeading]), group.controls[i],
                        group.noise[i], group.states[i], group.left[i], kWalks);
}

// Applies the event at which a walker stopped; returns the time that it has left.
double resolve(const MotionContext& context, const KneedAdvance& done, double left,
               WalkerParticle& particle, Rng& rng, Outcome& outcome) {
  switch (done.event) {
    case KneedEvent::kNone:
      return 0;
    case KneedEvent::kTransfer:
      change_support(context, particle, rng);
      return left - done.elapsed;
    case KneedEvent::kFallen:
    case KneedEvent::kDiverged:
      break;
  }
  outcome = done.event == KneedEvent::kFallen ? Outcome::kFallen : Outcome::kDiverged;
  catch_step(context, particle);
  return 0;
}

}  // namespace

void walk_on(const MotionContext& context, std::span<WalkerParticle> particles, std::span<Rng> rngs,
             std::span<Outcome> outcomes) {
  std::fill(outcomes.begin(), outcomes.end(), Outcome::kAlive);
  Scratch<32 * 1024> scratch;
  Group group(particles.size(), scratch.memory());
  gather(context, particles, rngs, group);
  const auto has_time = [](double left) { return left > 0; };
  while (std::any_of(group.left.begin(), group.left.end(), has_time)) {
    advance(context, particles, group);
    for (size_t i = 0; i < particles.size(); ++i) {
      if (!has_time(group.left[i])) continue;
      WalkerParticle& p = particles[i];
      p.walker = group.states[i];
      group.left[i] = resolve(context, group.done[i], group.left[i], p, rngs[i], outcomes[i]);
      group.states[i] = p.walker;
      group.controls[i] = p.controls;
    }
  }
}

}  // namespace tracker
}  // namespace walktrack
