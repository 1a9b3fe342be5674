// From light to bytes: exposure, flicker, noise, rounding.
#pragma once

#include <cstdint>
#include <vector>

#include "synth/recording/view.h"

namespace walktrack {
inline namespace synth {

struct Sensor {
  double exposure = 1;      // brightness factor; 0.25 is low light
  double noise = 0.01;      // standard deviation of a pixel's noise, of full scale
  double flicker = 0;       // relative standard deviation of a frame's brightness
  bool monochrome = false;  // the same value, and the same noise, in all channels
};

// Blue, green, red bytes, row-major. Noise is Gaussian (1024 quantiles), independent for each pixel
// and channel, and keyed by (seed, stream, frame): it does not depend on the number of threads or
// the order of frames.
std::vector<uint8_t> developed(const Plane<Colour>& light, const Sensor& sensor, uint64_t seed,
                               uint32_t stream, uint32_t frame);

}  // namespace synth
}  // namespace walktrack
