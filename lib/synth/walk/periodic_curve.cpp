#include "synth/walk/periodic_curve.h"

#include <cmath>
#include <utility>

namespace walktrack {
inline namespace synth {

PeriodicCurve::PeriodicCurve(std::vector<CurveKey> keys) : keys_(std::move(keys)) {
  keys_.push_back({1, keys_.front().value});
  const size_t last = keys_.size() - 1;
  const auto rise = [&](size_t i) {
    return (keys_[i + 1].value - keys_[i].value) / (keys_[i + 1].at - keys_[i].at);
  };
  for (size_t i = 0; i <= last; ++i) {
    const double before = rise(i == 0 ? last - 1 : i - 1), after = rise(i == last ? 0 : i);
    slopes_.push_back(before * after <= 0 ? 0 : 2 * before * after / (before + after));
  }
}

double PeriodicCurve::operator()(double stride) const {
  stride -= std::floor(stride);
  size_t i = 0;
  while (i + 2 < keys_.size() && stride > keys_[i + 1].at) ++i;
  const double span = keys_[i + 1].at - keys_[i].at, s = (stride - keys_[i].at) / span;
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * keys_[i].value + (s3 - 2 * s2 + s) * span * slopes_[i] +
         (3 * s2 - 2 * s3) * keys_[i + 1].value + (s3 - s2) * span * slopes_[i + 1];
}

}  // namespace synth
}  // namespace walktrack
