#include "gait/prior/gait_prior.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace walktrack {
inline namespace gait {
namespace {

// Limits of a feedback's correction: for square roots of stiffness and damping relative to the
// gait's own, for rest angles absolute (rad), for the impulse relative. By hand.
constexpr double kMaxCorrection = 0.4;
constexpr double kMaxRestCorrection = 0.3;

GaitNode blended(const GaitPrior& prior, const GaitTarget& at) {
  GaitNode blend;
  blend.cyclic = blend.valid = true;
  for (const auto& [index, cubic, linear] : node_shares(prior, at)) {
    const GaitNode& node = prior.nodes[index];
    blend.gait += cubic * node.gait;
    if (linear == 0) continue;
    blend.gain += linear * node.gain;
    blend.cost_of_transport += linear * node.cost_of_transport;
    blend.clearance += linear * node.clearance;
    blend.multiplier += linear * node.multiplier;
    blend.cyclic = blend.cyclic && node.cyclic;
    blend.valid = blend.valid && node.valid;
  }
  return blend;
}

}  // namespace

PriorGait gait_at(const GaitPrior& prior, const KneedParameters& parameters, double speed,
                  double step_length) {
  PriorGait gait;
  gait.units = walker_units(parameters);
  GaitTarget at = within(
      prior, {speed / gait.units.speed(), step_length / gait.units.length, parameters.slope});
  GaitNode node = blended(prior, at);
  for (int i = 0; i < kMaxShifts && !node.cyclic; ++i) {
    at = shifted(at);
    node = blended(prior, at);
  }
  gait.speed = at.speed * gait.units.speed();
  gait.step_length = at.step_length * gait.units.length;
  gait.slope = at.slope;
  gait.period = gait.step_length / gait.speed;
  gait.controls = scaled(controls_from(node.gait.head<kControlSize>()), WalkerUnits{}, gait.units);
  const KneedModel model = kneed_model(unit_walker(at.slope));
  if (const auto start = state_from(model, node.gait.tail<kSectionSize>()))
    gait.start = scaled(*start, WalkerUnits{}, gait.units);
  gait.cost_of_transport = node.cost_of_transport;
  gait.clearance = node.clearance * gait.units.length;
  gait.multiplier = node.multiplier;
  gait.valid = node.valid;
  gait.vector = node.gait;
  gait.gain = node.gain;
  return gait;
}

KneedState state_at_phase(const KneedModel& model, const PriorGait& gait, double phase) {
  KneedState state = gait.start;
  kneed_advance(model, gait.controls, Vector5::Zero(), state,
                std::clamp(phase, 0.0, 1.0) * gait.period);
  return state;
}

KneedControls next_controls(const PriorGait& gait, const KneedState& state, double strength) {
  if (strength == 0) return gait.controls;
  const ControlVector own = gait.vector.head<kControlSize>();
  const SectionVector section = section_of(scaled(state, gait.units, WalkerUnits{}));
  const ControlVector wanted =
      -strength * (gait.gain * (section - gait.vector.tail<kSectionSize>()));
  ControlVector controls = own;
  for (int i = 0; i < kControlSize; ++i) {
    const bool rest = i % 3 == 2;
    const double bound = rest ? kMaxRestCorrection : kMaxCorrection * std::max(own[i], 0.1);
    controls[i] += std::clamp(wanted[i], -bound, bound);
    if (!rest) controls[i] = std::max(0.0, controls[i]);
  }
  return scaled(controls_from(controls), WalkerUnits{}, gait.units);
}

KneedControls draw_controls(Rng& rng, const KneedControls& controls, const GaitNoise& noise) {
  KneedControls c = controls;
  for (SpringDamper* joint : {&c.torso, &c.hip, &c.stance_knee, &c.swing_knee}) {
    joint->stiffness *= draw_factor(rng, noise.relative);
    joint->damping *= draw_factor(rng, noise.relative);
    joint->rest += draw_deviation(rng, noise.rest);
  }
  c.toe_off_impulse *= draw_factor(rng, noise.relative);
  return c;
}

double log_density(const KneedControls& drawn, const KneedControls& controls,
                   const GaitNoise& noise) {
  const std::array<std::array<const SpringDamper*, 2>, 4> joints{
      {{&drawn.torso, &controls.torso},
       {&drawn.hip, &controls.hip},
       {&drawn.stance_knee, &controls.stance_knee},
       {&drawn.swing_knee, &controls.swing_knee}}};
  const auto factor = [&](double value, double mean) {
    return log_factor_density(value, mean, noise.relative);
  };
  double sum = factor(drawn.toe_off_impulse, controls.toe_off_impulse);
  for (const auto& [value, mean] : joints)
    sum += factor(value->stiffness, mean->stiffness) + factor(value->damping, mean->damping) +
           log_deviation_density(value->rest - mean->rest, noise.rest);
  return sum;
}

Vector5 draw_torques(Rng& rng, const WalkerUnits& units, const GaitNoise& noise, double duration) {
  const double sd = torque_deviation(noise, units, duration);
  if (sd == 0) return Vector5::Zero();
  const double torso = sd * rng.normal(), hip = sd * rng.normal();
  const double stance_knee = sd * rng.normal(), swing_knee = sd * rng.normal();
  return {torso, -torso - hip - stance_knee, hip - swing_knee, stance_knee, swing_knee};
}

}  // namespace gait
}  // namespace walktrack
