#include "tracker/start/start.h"

#include <algorithm>
#include <cmath>

#include "core/conventions.h"
#include "tracker/motion/standing.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Draws steps with about the length of people's steps at that speed, m/s.
StepAim draw_aim(const MotionContext& context, const StartConfig& config, double speed, Rng& rng) {
  const double leg = leg_length(context.model.body.lengths);
  const double unit_speed = std::sqrt(context.model.walker.parameters.gravity * leg);
  speed *= std::exp(config.speed * rng.truncated_normal(2.5));
  return {speed, leg * preferred_step_length(speed / unit_speed) *
                     std::exp(config.step_length * rng.truncated_normal(2.5))};
}

void place(const MotionContext& context, const Eigen::Vector2d& position, WalkerParticle& p) {
  p.predicted_ball.setZero();
  p.predicted_residual = p.residual;
  context.moves.apply_noise(context, p);
  p.predicted_ball = position - p.pose.root.head<2>();
  context.moves.apply_noise(context, p);
  p.pose_before = p.pose;
}

}  // namespace

std::vector<PhaseRange> phase_ranges(const StartConfig& config) {
  std::vector<PhaseRange> ranges;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    for (int k = 0; k < config.phases; ++k)
      ranges.push_back({side, double(k) / config.phases, double(k + 1) / config.phases});
  }
  return ranges;
}

std::vector<PhaseRange> phase_ranges(const StartConfig& config, double stride_phase) {
  const double steps = 2 * (stride_phase - std::floor(stride_phase));
  const Side side = steps < 1 ? Side::kLeft : Side::kRight;
  const double phase = steps - std::floor(steps), width = 1.0 / config.phases;
  std::vector<PhaseRange> ranges{
      {side, std::max(0.0, phase - width), std::min(1.0, phase + width)}};
  if (phase < width) ranges.push_back({other(side), 1 + phase - width, 1});
  if (phase > 1 - width) ranges.push_back({other(side), 0, phase + width - 1});
  return ranges;
}

std::vector<WalkerParticle> spawn(const MotionContext& context, const StartConfig& config,
                                  const DetectedWalk& detected, const PhaseRange& range,
                                  uint64_t seed) {
  std::vector<WalkerParticle> out(static_cast<size_t>(config.particles));
  std::vector<Eigen::Vector2d> positions(out.size());
  std::vector<double> phases(out.size());
  for (size_t i = 0; i < out.size(); ++i) {
    Rng rng(seed, Purpose::kInitialisation, 0, static_cast<uint32_t>(i));
    WalkerParticle& p = out[i];
    positions[i] =
        detected.position + detected.position_sd * rng.truncated_normal(2.5) * detected.ray;
    const Eigen::Vector2d velocity =
        detected.velocity + detected.velocity_sd * rng.truncated_normal(2.5) * detected.ray;
    p.aim = draw_aim(context, config, velocity.norm(), rng);
    p.stance = range.stance;
    for (const ResidualAngle k : kAllResiduals) p.residual[k] = context.markov[k].rest;
    p.residual[kHeading] = std::atan2(velocity.y(), velocity.x());
    p.residual_before = p.residual;
    phases[i] = range.from + (range.to - range.from) * rng.uniform();
  }
  context.moves.initialise(context, phases, out);
  if (detected.standing) std::for_each(out.begin(), out.end(), stand);
  for (size_t i = 0; i < out.size(); ++i) place(context, positions[i], out[i]);
  return out;
}

NoiseScale start_scale(const StartConfig& config, const MotionModel& moves,
                       const MotionConfig& motion, const NoiseScale& frame) {
  NoiseScale scale = frame;
  for (const ResidualAngle k : kAllResiduals) scale.residual[k] = moves.start_spread(motion, k);
  scale.residual[kHeading] = rad_from_deg(config.heading_deg);
  return scale;
}

}  // namespace tracker
}  // namespace walktrack
