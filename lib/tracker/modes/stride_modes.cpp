#include "tracker/modes/stride_modes.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/conventions.h"

namespace walktrack {
inline namespace tracker {

namespace {

constexpr double kEighth = 0.125;  // of a stride

double whole_turns_off(double phase) { return phase - std::floor(phase); }

// Strides from `a` to `b`, by the shorter way.
double strides_between(double a, double b) { return std::remainder(b - a, 1.0); }

}  // namespace

double stride_phase(const WalkerParticle& particle) {
  constexpr double kBeforeStrike = 1 - 1e-9;  // a late strike is still expected
  const double step =
      std::clamp(particle.walker.since_transfer / particle.aim.duration(), 0.0, kBeforeStrike);
  return 0.5 * (step + (particle.stance == Side::kLeft ? 0 : 1));
}

double leading_phase(std::span<const double> phases, std::span<const double> weights) {
  // The doubled angle is the same for both modes and gives the line on which they are.
  std::complex<double> doubled = 0;
  for (size_t i = 0; i < phases.size(); ++i)
    doubled += weights[i] * std::polar(1.0, 4 * kPi * phases[i]);
  const double one = std::arg(doubled) / (4 * kPi);
  const double leading = mass_apart(one, phases, weights) > 0.5 ? one + 0.5 : one;
  double beyond = 0, mass = 0;
  for (size_t i = 0; i < phases.size(); ++i) {
    if (apart(leading, phases[i])) continue;
    beyond += weights[i] * strides_between(leading, phases[i]);
    mass += weights[i];
  }
  return whole_turns_off(leading + beyond / mass);
}

bool apart(double phase, double other) { return std::abs(strides_between(phase, other)) > 0.25; }

bool mirrored(double phase, double other) {
  return std::abs(strides_between(phase, other)) > 0.5 - kEighth;
}

double mass_apart(double phase, std::span<const double> phases, std::span<const double> weights) {
  double mass = 0;
  for (size_t i = 0; i < phases.size(); ++i)
    if (apart(phase, phases[i])) mass += weights[i];
  return mass;
}

StrideModes stride_modes(std::span<const WalkerParticle> particles,
                         std::span<const double> weights) {
  // Particles that stand have no phase.
  std::vector<double> phases, shares;
  phases.reserve(particles.size());
  shares.reserve(particles.size());
  double walking = 0;
  for (size_t i = 0; i < particles.size(); ++i) {
    if (particles[i].regime == Regime::kStanding) continue;
    phases.push_back(stride_phase(particles[i]));
    shares.push_back(weights[i]);
    walking += weights[i];
  }
  StrideModes out{.standing = std::max(0.0, 1 - walking)};
  if (phases.size() == particles.size()) out.standing = 0;
  if (!(walking > 0)) return out;
  if (out.standing > 0)
    for (double& share : shares) share /= walking;
  out.phase = leading_phase(phases, shares);
  out.p_legs_swapped = mass_apart(out.phase, phases, shares);
  return out;
}

double phase_ahead(std::span<const WalkerParticle> particles, std::span<const double> weights,
                   double dt) {
  double steps = 0;  // per second
  for (size_t i = 0; i < particles.size(); ++i)
    if (particles[i].regime == Regime::kWalking) steps += weights[i] / particles[i].aim.duration();
  return whole_turns_off(stride_modes(particles, weights).phase + 0.5 * steps * dt);
}

bool label_switched(double expected, double phase) {
  const auto legs_pass = [](double at) {
    return std::abs(std::remainder(at - 0.25, 0.5)) < kEighth;
  };
  return legs_pass(expected) && legs_pass(phase) && mirrored(expected, phase);
}

}  // namespace tracker
}  // namespace walktrack
