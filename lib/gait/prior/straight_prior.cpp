#include "gait/prior/straight_prior.h"

#include <algorithm>
#include <cmath>

#include "core/conventions.h"

namespace walktrack {
inline namespace gait {
namespace {

// Limit of a feedback's correction, as a share of the control, or of kLeastControl if the control
// is smaller. By hand.
constexpr double kMaxStraightCorrection = 0.4;
constexpr double kLeastControl = 0.05;

StraightNode blended(const StraightPrior& prior, const GaitTarget& at) {
  StraightNode blend;
  blend.valid = true;
  for (const auto& [index, cubic, linear] : node_shares(prior, at)) {
    const StraightNode& node = prior.nodes[index];
    blend.gait += cubic * node.gait;
    if (linear == 0) continue;
    blend.gain += linear * node.gain;
    blend.cost_of_transport += linear * node.cost_of_transport;
    blend.multiplier += linear * node.multiplier;
    blend.valid = blend.valid && node.valid;
  }
  return blend;
}

// The target moved into the table, and its step length to the nearest one with a valid gait: at low
// speeds there are no long steps, and downhill no short ones. If a speed has no valid gait the
// target keeps its step length.
GaitTarget nearest_valid(const StraightPrior& prior, const GaitTarget& wished) {
  const GaitTarget at = within(prior, wished);
  const double preferred = preferred_step_length(at.speed);
  constexpr double kStride = 0.01;  // share of the preferred step; by hand
  const double span = (prior.ratios.back() - prior.ratios.front()) * preferred;
  for (double shift = 0; shift <= span; shift += kStride * preferred)
    for (const double side : {-1.0, 1.0}) {
      GaitTarget trial = at;
      trial.step_length += side * shift;
      trial = within(prior, trial);
      if (blended(prior, trial).valid) return trial;
    }
  return at;
}

StraightControls in_units(const StraightGaitVector& gait, const WalkerUnits& units) {
  return {std::max(0.0, gait[0]) * units.torque(), std::max(0.0, gait[1]) * units.impulse()};
}

}  // namespace

StraightLeggedParameters adult_straight_walker(double height, double mass, double slope) {
  const double leg = walker_units(adult_walker(height, mass)).length;
  StraightLeggedParameters p = straight_walker({leg, mass, kStandardGravity});
  p.slope = slope;
  return p;
}

StraightLeggedParameters straight_walker(const WalkerUnits& units) {
  StraightLeggedParameters p;
  p.gravity = units.gravity;
  p.hip_mass *= units.mass;
  p.leg_mass *= units.mass;
  p.leg_inertia *= units.mass * units.length * units.length;
  p.hip_to_arc *= units.length;
  p.com_below_hip *= units.length;
  p.foot_radius *= units.length;
  return p;
}

WalkerUnits walker_units(const StraightLeggedParameters& p) {
  return {p.hip_to_arc + p.foot_radius, p.hip_mass + 2 * p.leg_mass, p.gravity};
}

StraightGait gait_at(const StraightPrior& prior, const StraightLeggedParameters& parameters,
                     double speed, double step_length) {
  StraightGait gait;
  gait.units = walker_units(parameters);
  const GaitTarget at = nearest_valid(
      prior, {speed / gait.units.speed(), step_length / gait.units.length, parameters.slope});
  const StraightNode node = blended(prior, at);
  gait.speed = at.speed * gait.units.speed();
  gait.step_length = at.step_length * gait.units.length;
  gait.slope = at.slope;
  gait.period = gait.step_length / gait.speed;
  gait.controls = in_units(node.gait, gait.units);
  gait.start = straight_state_from(node.gait.tail<kStraightSectionSize>());
  gait.start.qd /= gait.units.time();
  gait.cost_of_transport = node.cost_of_transport;
  gait.multiplier = node.multiplier;
  gait.valid = node.valid;
  gait.vector = node.gait;
  gait.gain = node.gain;
  return gait;
}

StraightState state_at_phase(const StraightModel& model, const StraightGait& gait, double phase) {
  StraightState state = gait.start;
  straight_advance(model, gait.controls, Vector2::Zero(), state,
                   std::clamp(phase, 0.0, 1.0) * gait.period);
  return state;
}

StraightSection section_of(const StraightGait& gait, const StraightState& state) {
  StraightSection section = section_of(state);
  section.tail<2>() *= gait.units.time();
  return section;
}

StraightControls next_controls(const StraightGait& gait, const StraightState& state,
                               double strength) {
  if (strength == 0) return gait.controls;
  const StraightSection off = section_of(gait, state) - gait.vector.tail<kStraightSectionSize>();
  const Vector2 wanted = -strength * (gait.gain * off);
  StraightGaitVector corrected = gait.vector;
  for (int i = 0; i < kStraightControlSize; ++i) {
    const double bound = kMaxStraightCorrection * std::max(corrected[i], kLeastControl);
    corrected[i] += std::clamp(wanted[i], -bound, bound);
  }
  return in_units(corrected, gait.units);
}

StraightControls draw_controls(Rng& rng, const StraightControls& controls, const GaitNoise& noise) {
  StraightControls drawn = controls;
  drawn.stiffness *= draw_factor(rng, noise.relative);
  drawn.toe_off_impulse *= draw_factor(rng, noise.relative);
  return drawn;
}

double log_density(const StraightControls& drawn, const StraightControls& controls,
                   const GaitNoise& noise) {
  return log_factor_density(drawn.stiffness, controls.stiffness, noise.relative) +
         log_factor_density(drawn.toe_off_impulse, controls.toe_off_impulse, noise.relative);
}

Vector2 draw_hip_torque(Rng& rng, const WalkerUnits& units, const GaitNoise& noise,
                        double duration) {
  const double sd = torque_deviation(noise, units, duration);
  if (sd == 0) return Vector2::Zero();
  const double torque = sd * rng.normal();
  return {-torque, torque};
}

}  // namespace gait
}  // namespace walktrack
