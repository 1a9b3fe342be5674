#include "metrics/cycle_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace walktrack {
inline namespace metrics {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double value_at(std::span<const double> time, std::span<const double> values, double t) {
  const auto after = std::lower_bound(time.begin(), time.end(), t);
  if (after == time.end()) return kNaN;
  const auto i = static_cast<size_t>(after - time.begin());
  if (time[i] == t) return values[i];
  if (i == 0) return kNaN;
  const double share = (t - time[i - 1]) / (time[i] - time[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

// The share of the stride at which its foot leaves the ground.
double toe_off_of(const Gait& gait, const Stride& stride) {
  for (const GaitEvent& event : gait.events) {
    if (event.side == stride.side && event.kind == GaitEventKind::kToeOff &&
        event.time > stride.from && event.time < stride.to)
      return (event.time - stride.from) / (stride.to - stride.from);
  }
  return 0;
}

bool complete(const CycleCurve& curve) {
  return std::all_of(curve.begin(), curve.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

std::vector<Stride> strides_of(const Gait& gait) {
  constexpr double kLongest = 3, kPause = 1.5;  // s; by hand
  std::vector<Stride> strides;
  std::array<double, 2> last{kNaN, kNaN};
  double before = kNaN;  // the last event of any foot
  for (const GaitEvent& event : gait.events) {
    if (event.time - std::exchange(before, event.time) > kPause) last = {kNaN, kNaN};
    if (event.kind != GaitEventKind::kFootStrike) continue;
    double& from = last[static_cast<size_t>(event.side)];
    if (event.time - from <= kLongest) strides.push_back({event.side, from, event.time});
    from = event.time;
  }
  for (Stride& stride : strides) stride.toe_off = toe_off_of(gait, stride);
  std::sort(strides.begin(), strides.end(),
            [](const Stride& a, const Stride& b) { return a.from < b.from; });
  return strides;
}

CycleCurve over_stride(std::span<const double> time, std::span<const double> values,
                       const Stride& stride) {
  CycleCurve curve;
  for (size_t i = 0; i < kCyclePoints; ++i) {
    const double share = static_cast<double>(i) / (kCyclePoints - 1);
    curve[i] = value_at(time, values, stride.from + share * (stride.to - stride.from));
  }
  return curve;
}

CycleBand band_of(std::span<const CycleCurve> curves) {
  CycleBand band;
  band.mean.fill(kNaN);
  band.sd.fill(kNaN);
  band.count = static_cast<size_t>(std::count_if(curves.begin(), curves.end(), complete));
  if (band.count == 0) return band;
  const auto n = static_cast<double>(band.count);
  for (size_t i = 0; i < kCyclePoints; ++i) {
    double sum = 0, squares = 0;
    for (const CycleCurve& curve : curves)
      if (complete(curve)) sum += curve[i];
    band.mean[i] = sum / n;
    for (const CycleCurve& curve : curves)
      if (complete(curve)) squares += (curve[i] - band.mean[i]) * (curve[i] - band.mean[i]);
    band.sd[i] = band.count > 1 ? std::sqrt(squares / (n - 1)) : 0;
  }
  return band;
}

}  // namespace metrics
}  // namespace walktrack
