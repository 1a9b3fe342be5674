// A periodic curve over the stride, from strike to strike, through several points.
#pragma once

#include <vector>

namespace walktrack {
inline namespace synth {

struct CurveKey {
  double at;  // share of the stride, 0 <= at < 1
  double value;
};

// Cubic interpolation between keys with slopes for which it has no extrema except at keys (Fritsch
// & Butland, SIAM J. Sci. Stat. Comput. 5, 1984).
class PeriodicCurve {
 public:
  // At least two keys, `at` increasing from 0.
  explicit PeriodicCurve(std::vector<CurveKey> keys);

  double operator()(double stride) const;

 private:
  std::vector<CurveKey> keys_;  // the first one is repeated at 1
  std::vector<double> slopes_;  // at the keys
};

}  // namespace synth
}  // namespace walktrack
