// The number of particles that a frame can have within its budget, from the time that frames have
// taken:
//   seconds = fixed + particles * each
// `fixed` (decoding, evidence) and `each` (the filter) are measured in every frame and averaged
// over the last ten or so. Only here results depend on the clock.
#pragma once

#include "io/config/config.h"

namespace walktrack {
inline namespace jobs {

class ParticleBudget {
 public:
  // UsageError for bounds that leave nothing between them.
  explicit ParticleBudget(const BudgetConfig& config);

  bool on() const { return config_.frame_ms > 0; }

  // A number brought within the configuration's bounds.
  int bounded(double particles) const;

  // The number for the next frame, after one with `particles` that took `fixed_seconds` and, for
  // the filter, `filter_seconds`. Within bounds; at most half as many again or
  // two thirds as many as before, so that one slow frame does not starve the next.
  int next(int particles, double fixed_seconds, double filter_seconds);

 private:
  BudgetConfig config_;
  double fixed_ = -1, each_ = 0;  // s, averages; negative before the first frame
};

}  // namespace jobs
}  // namespace walktrack
