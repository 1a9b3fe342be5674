// The number of particles for a frame within its time budget, from the measured times of earlier
// frames:
//   seconds = fixed + particles * each
// `fixed` (decoding, evidence) and `each` (the filter) are measured in every frame and averaged
// over about ten frames. Only here results depend on measured time.
#pragma once

#include "io/config/config.h"

namespace walktrack {
inline namespace jobs {

class ParticleBudget {
 public:
  // UsageError if the lower bound is above the upper one.
  explicit ParticleBudget(const BudgetConfig& config);

  bool on() const { return config_.frame_ms > 0; }

  // A number clamped to the configuration's bounds.
  int bounded(double particles) const;

  // The number for the next frame after a frame with `particles` that took `fixed_seconds` and, for
  // the filter, `filter_seconds`. It is within bounds and changes by a factor of at most 1.5 either
  // way, so that one slow frame has little effect on the next.
  int next(int particles, double fixed_seconds, double filter_seconds);

 private:
  BudgetConfig config_;
  double fixed_ = -1, each_ = 0;  // s, averages; negative before the first frame
};

}  // namespace jobs
}  // namespace walktrack
