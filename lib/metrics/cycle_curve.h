// Curves over the gait cycle: a signal is cut at the foot strikes of one side, each stride is
// scaled to 0-100 %, and strides are averaged.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "metrics/gait.h"

namespace walktrack {
inline namespace metrics {

inline constexpr size_t kCyclePoints = 101;  // 0 %, 1 %, ..., 100 %
using CycleCurve = std::array<double, kCyclePoints>;

// From one strike of a foot to its next one.
struct Stride {
  Side side;
  double from, to;     // s
  double toe_off = 0;  // share of the stride; 0 = unknown
};

// In order of time. A stride that is longer than those of the slowest walkers contains an event
// that was missed, and one with a pause between events ends in another walk: they are left out.
std::vector<Stride> strides_of(const Gait& gait);

// The signal over the stride, linear between samples; NaN within a gap (samples that are NaN) and
// outside the signal. `time` increases.
CycleCurve over_stride(std::span<const double> time, std::span<const double> values,
                       const Stride& stride);

// Mean and standard deviation (n - 1; 0 for one curve) at every per cent, over the curves without a
// gap; NaN if there are none.
struct CycleBand {
  CycleCurve mean, sd;
  size_t count = 0;
};
CycleBand band_of(std::span<const CycleCurve> curves);

}  // namespace metrics
}  // namespace walktrack
