// A curve over the stride, strike to strike, through a few points of it.
#pragma once

#include <vector>

namespace walktrack {
inline namespace synth {

struct CurveKey {
  double at;  // share of the stride, 0 <= at < 1
  double value;
};

// Cubic between keys, with slopes that add no hill or hollow of its own (Fritsch & Butland, SIAM J.
// Sci. Stat. Comput. 5, 1984): level where keys are.
class PeriodicCurve {
 public:
  // At least two keys, `at` increasing from 0.
  explicit PeriodicCurve(std::vector<CurveKey> keys);

  double operator()(double stride) const;

 private:
  std::vector<CurveKey> keys_;  // the first one again at 1
  std::vector<double> slopes_;  // at the keys
};

}  // namespace synth
}  // namespace walktrack
