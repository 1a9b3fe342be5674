#include "gait/gait_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace walktrack {
inline namespace gait {
namespace {

// Draws beyond so many standard deviations are repeated: one draw in 370. By hand.
constexpr double kTruncation = 3;
constexpr double kNever = -std::numeric_limits<double>::infinity();

}  // namespace

double draw_deviation(Rng& rng, double sd) {
  return sd > 0 ? sd * rng.truncated_normal(kTruncation) : 0.0;
}

double draw_factor(Rng& rng, double sd) { return std::max(0.0, 1 + draw_deviation(rng, sd)); }

double log_deviation_density(double deviation, double sd) {
  const double z = deviation / sd;
  if (!(std::abs(z) <= kTruncation)) return kNever;
  const double mass = std::erf(kTruncation / std::numbers::sqrt2);
  return -0.5 * z * z - std::log(sd * std::sqrt(2 * std::numbers::pi) * mass);
}

double log_factor_density(double value, double mean, double sd) {
  if (mean == 0) return value == 0 ? 0.0 : kNever;
  return log_deviation_density(value / mean - 1, sd);
}

double torque_deviation(const GaitNoise& noise, const WalkerUnits& units, double duration) {
  if (noise.torque <= 0 || duration <= 0) return 0;
  constexpr double kReference = 1.0 / 30;  // s, for which GaitNoise::torque is stated
  return noise.torque * units.torque() * std::sqrt(kReference / duration);
}

}  // namespace gait
}  // namespace walktrack
