#include "gait/gait_prior.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace walktrack {
namespace {

// Bounds of a feedback's correction, in square roots of stiffness and damping relative to the
// gait's own, and absolute for rest angles (rad) and relative for the impulse.
constexpr double kMaxCorrection = 0.4;
constexpr double kMaxRestCorrection = 0.3;

// Noise is cut at this many standard deviations: none of 1,000 particles leaves the basin by a
// single draw, and 0.3 % of the mass is lost.
constexpr double kTruncation = 3;

// A step length among nodes that are no cycles moves to the preferred one by this share, this
// often.
constexpr double kShift = 0.1;
constexpr int kMaxShifts = 20;

// Four neighbours on an axis with the weights of cubic Hermite interpolation (tangents through the
// neighbours; straight towards the ends), and linear weights of the two that enclose the value.
struct AxisWeights {
  std::array<size_t, 4> index{};
  std::array<double, 4> cubic{};
  std::array<double, 4> linear{};
};

AxisWeights axis_weights(const std::vector<double>& axis, double value) {
  AxisWeights w;
  if (axis.size() == 1) {
    w.cubic = w.linear = {0, 1, 0, 0};
    return w;
  }
  const auto above = std::upper_bound(axis.begin() + 1, axis.end() - 1, value);
  const auto i = static_cast<size_t>(above - axis.begin()) - 1;
  const size_t before = i == 0 ? i : i - 1, after = std::min(i + 2, axis.size() - 1);
  const double width = axis[i + 1] - axis[i];
  const double t = std::clamp((value - axis[i]) / width, 0.0, 1.0);
  const double left = width * t * (1 - t) * (1 - t) / (axis[i + 1] - axis[before]);
  const double right = -width * t * t * (1 - t) / (axis[after] - axis[i]);
  const double rise = t * t * (3 - 2 * t);
  w.index = {before, i, i + 1, after};
  w.linear = {0, 1 - t, t, 0};
  w.cubic = {-left, 1 - rise - right, rise + left, right};
  return w;
}

GaitNode blended(const GaitPrior& prior, const GaitTarget& at) {
  const double ratio = at.step_length / preferred_step_length(at.speed);
  const AxisWeights s = axis_weights(prior.speeds, at.speed);
  const AxisWeights r = axis_weights(prior.ratios, ratio);
  const AxisWeights g = axis_weights(prior.slopes, at.slope);
  GaitNode blend;
  blend.cyclic = blend.valid = true;
  for (size_t i = 0; i < 4; ++i)
    for (size_t j = 0; j < 4; ++j)
      for (size_t k = 0; k < 4; ++k) {
        const double cubic = s.cubic[i] * r.cubic[j] * g.cubic[k];
        const double linear = s.linear[i] * r.linear[j] * g.linear[k];
        if (cubic == 0 && linear == 0) continue;
        const GaitNode& node = prior.node(s.index[i], r.index[j], g.index[k]);
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

double preferred_step_length(double speed) {
  constexpr double kLeg = 0.9275, kStep = 0.694, kSpeed = 1.25, kGravity = 9.80665;
  return kStep / kLeg * std::pow(speed * std::sqrt(kGravity * kLeg) / kSpeed, 0.42);
}

PriorGait gait_at(const GaitPrior& prior, const KneedParameters& parameters, double speed,
                  double step_length) {
  PriorGait gait;
  gait.units = walker_units(parameters);
  GaitTarget at;
  at.speed = std::clamp(speed / gait.units.speed(), prior.speeds.front(), prior.speeds.back());
  const double preferred = preferred_step_length(at.speed);
  at.step_length = std::clamp(step_length / gait.units.length, preferred * prior.ratios.front(),
                              preferred * prior.ratios.back());
  at.slope = std::clamp(parameters.slope, prior.slopes.front(), prior.slopes.back());
  GaitNode node = blended(prior, at);
  for (int i = 0; i < kMaxShifts && !node.cyclic; ++i) {
    at.step_length += kShift * (preferred - at.step_length);
    node = blended(prior, at);
  }
  gait.speed = at.speed * gait.units.speed();
  gait.step_length = at.step_length * gait.units.length;
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

double phase_of(const PriorGait& gait, const KneedState& state) {
  return std::clamp(state.since_transfer / gait.period, 0.0, 1.0);
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
  const auto draw = [&](double sd) {
    return sd > 0 ? sd * rng.truncated_normal(kTruncation) : 0.0;
  };
  const auto factor = [&] { return std::max(0.0, 1 + draw(noise.relative)); };
  KneedControls c = controls;
  for (SpringDamper* joint : {&c.torso, &c.hip, &c.stance_knee, &c.swing_knee}) {
    joint->stiffness *= factor();
    joint->damping *= factor();
    joint->rest += draw(noise.rest);
  }
  c.toe_off_impulse *= factor();
  return c;
}

double log_density(const KneedControls& drawn, const KneedControls& controls,
                   const GaitNoise& noise) {
  const auto log_normal = [](double deviation, double sd) {
    const double z = deviation / sd;
    if (!(std::abs(z) <= kTruncation)) return -std::numeric_limits<double>::infinity();
    const double mass = std::erf(kTruncation / std::numbers::sqrt2);
    return -0.5 * z * z - std::log(sd * std::sqrt(2 * std::numbers::pi) * mass);
  };
  const auto relative = [&](double value, double mean) {
    return mean == 0 ? (value == 0 ? 0.0 : -std::numeric_limits<double>::infinity())
                     : log_normal(value / mean - 1, noise.relative);
  };
  const std::array<std::array<const SpringDamper*, 2>, 4> joints{
      {{&drawn.torso, &controls.torso},
       {&drawn.hip, &controls.hip},
       {&drawn.stance_knee, &controls.stance_knee},
       {&drawn.swing_knee, &controls.swing_knee}}};
  double sum = relative(drawn.toe_off_impulse, controls.toe_off_impulse);
  for (const auto& [value, mean] : joints)
    sum += relative(value->stiffness, mean->stiffness) + relative(value->damping, mean->damping) +
           log_normal(value->rest - mean->rest, noise.rest);
  return sum;
}

Vector5 draw_torques(Rng& rng, const WalkerUnits& units, const GaitNoise& noise, double duration) {
  if (noise.torque <= 0 || duration <= 0) return Vector5::Zero();
  constexpr double kReference = 1.0 / 30;
  const double sd = noise.torque * units.torque() * std::sqrt(kReference / duration);
  const double torso = sd * rng.normal(), hip = sd * rng.normal();
  const double stance_knee = sd * rng.normal(), swing_knee = sd * rng.normal();
  return {torso, -torso - hip - stance_knee, hip - swing_knee, stance_knee, swing_knee};
}

}  // namespace walktrack
