#include "tracker/motion/stride.h"

#include <array>
#include <cmath>

#include "core/conventions.h"

namespace walktrack {
inline namespace tracker {

namespace {

constexpr int kSamples = 20;  // of a stride
// Degrees, at phases k / kSamples.
constexpr std::array<double, kSamples> kThigh_deg{0,   -4.8, -7.4, -7.3, -6.1, -4.3, -1.8,
                                                  0,   0,    0,    0,    0.9,  4.1,  4.7,
                                                  5.2, 4.0,  0.8,  -1.9, -2.5, -1.5};
constexpr std::array<double, kSamples> kShank_deg{
    0, 4.8, 7.4, 7.3, 6.1, 4.3, 1.8, 0, 0, 0, 0, -3.0, 0.1, 7.6, 13.8, 17.4, 13.7, 10.6, 5.5, -2.0};

// Cubic through the samples with their central differences as slopes (Catmull & Rom 1974).
double interpolated(const std::array<double, kSamples>& values, double phase) {
  const double at = kSamples * (phase - std::floor(phase));
  const int k = static_cast<int>(at);
  const double u = at - k;
  const auto value = [&](int i) { return values[static_cast<size_t>((i + kSamples) % kSamples)]; };
  const double a = value(k - 1), b = value(k), c = value(k + 1), d = value(k + 2);
  return b + 0.5 * u * (c - a + u * (2 * a - 5 * b + 4 * c - d + u * (3 * (b - c) + d - a)));
}

}  // namespace

LegDifference leg_difference(double phase) {
  return {rad_from_deg(interpolated(kThigh_deg, phase)),
          rad_from_deg(interpolated(kShank_deg, phase))};
}

}  // namespace tracker
}  // namespace walktrack
