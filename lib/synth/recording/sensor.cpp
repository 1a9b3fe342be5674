#include "synth/recording/sensor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/rng.h"

namespace walktrack {
inline namespace synth {

namespace {

// Ten bits of a random word select one of the mid-quantiles of the standard normal; one word is
// used for the three channels of a pixel. The largest value is 3.3; the variance is 1 % too small.
constexpr size_t kQuantiles = 1024;

// The quantile function of the standard normal, by bisection of erfc: exact to rounding.
double normal_quantile(double p) {
  double low = -10, high = 10;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::array<float, kQuantiles> quantile_table() {
  std::array<float, kQuantiles> table{};
  for (size_t i = 0; i < kQuantiles; ++i)
    table[i] = static_cast<float>(normal_quantile((static_cast<double>(i) + 0.5) / kQuantiles));
  return table;
}

uint8_t byte_of(float value) {
  return static_cast<uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

// Rec. 601.
Colour grey_of(const Colour& colour) {
  return Colour::Constant(0.299F * colour[0] + 0.587F * colour[1] + 0.114F * colour[2]);
}

}  // namespace

std::vector<uint8_t> developed(const Plane<Colour>& light, const Sensor& sensor, uint64_t seed,
                               uint32_t stream, uint32_t frame) {
  static const auto kTable = quantile_table();
  Rng rng(seed, Purpose::kRendering, frame, stream);
  const double flicker = sensor.flicker > 0 ? sensor.flicker * rng.truncated_normal(3) : 0;
  const float gain = static_cast<float>(sensor.exposure * (1 + flicker));
  const float noise = static_cast<float>(sensor.noise);
  std::vector<uint8_t> out(3 * light.values.size());
  uint8_t* to = out.data();
  for (const Colour& seen : light.values) {
    const Colour colour = sensor.monochrome ? grey_of(seen) : seen;
    const uint32_t word = noise > 0 ? rng.next() : 0;
    for (uint32_t channel = 0; channel < 3; ++channel) {
      const uint32_t shift = sensor.monochrome ? 0 : 10 * channel;
      const float draw = kTable[(word >> shift) & (kQuantiles - 1)];
      *to++ = byte_of(gain * colour[static_cast<Eigen::Index>(2 - channel)] + noise * draw);
    }
  }
  return out;
}

}  // namespace synth
}  // namespace walktrack
