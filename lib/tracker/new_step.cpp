#include "tracker/new_step.h"

#include <algorithm>
#include <cmath>

namespace walktrack {

namespace {

constexpr double kAimSpread = 0.15;  // relative, of the speed and the step length aimed at

PriorGait aim_anew(const MotionContext& context, WalkerParticle& particle, Rng& rng) {
  StepAim& aim = particle.aim;
  aim.speed *= std::exp(kAimSpread * rng.truncated_normal(2.5));
  aim.step_length *= std::exp(kAimSpread * rng.truncated_normal(2.5));
  PriorGait gait =
      gait_at(context.prior, context.model.walker.parameters, aim.speed, aim.step_length);
  aim = {gait.speed, gait.step_length};  // within the table
  return gait;
}

}  // namespace

void begin_step_anew(const MotionContext& context, WalkerParticle& particle, Rng& rng) {
  const Eigen::Vector2d root_before = particle.pose.root.head<2>();
  const Eigen::Vector2d root = 2 * root_before - particle.pose_before.root.head<2>();
  const PriorGait gait = aim_anew(context, particle, rng);
  const KneedModel& model = context.model.walker;
  const double phase = rng.uniform(), elapsed = std::min(context.dt, phase * gait.period);
  if (rng.uniform() < 0.5) particle.stance = other(particle.stance);
  particle.controls = gait.controls;
  const KneedState earlier = state_at_phase(model, gait, phase - elapsed / gait.period);
  particle.walker = earlier;
  kneed_advance(model, gait.controls, Vector5::Zero(), particle.walker, elapsed);
  const auto posed = [&](const KneedState& walker, const Extras& extra) {
    return pose_of(context.model, walker, particle.stance, particle.aim, Eigen::Vector2d::Zero(),
                   extra);
  };
  // What the flow sees is the new gait's own motion, not the leap to it.
  particle.pose_before = posed(earlier, particle.extra_before);
  particle.pose_before.root.head<2>() = root_before;
  particle.ball = root - posed(particle.walker, particle.predicted_extra).root.head<2>();
}

}  // namespace walktrack
