#include "metrics/steps/flat_feet.h"

#include <algorithm>

namespace walktrack {
inline namespace metrics {

namespace {

double mean_whole_stance(const Gait& gait) {
  double sum = 0, count = 0;
  for (const Stance& stance : gait.stances) {
    if (!stance.starts_in_motion || !stance.ends_in_motion) continue;
    sum += stance.off - stance.on;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

struct Span {
  double from, to;  // s
};

// `usual`: duration of a stance, s. A foot that has been on the ground for longer than that at the
// beginning of the motion is flat from the beginning on, and likewise at the end.
Span flat_part(const Stance& stance, double usual) {
  const double seen = stance.off - stance.on;
  const bool whole = stance.starts_in_motion && stance.ends_in_motion;
  const double length = whole ? seen : usual;
  Span out{stance.on, stance.off};
  if (stance.starts_in_motion)
    out.from = stance.on + kFlatFrom * length;
  else if (seen < length)
    out.from = std::max(stance.on, stance.off - (1 - kFlatFrom) * length);
  if (stance.ends_in_motion)
    out.to = stance.off - (1 - kFlatTo) * length;
  else if (seen < length)
    out.to = std::min(stance.off, stance.on + kFlatTo * length);
  return out;
}

}  // namespace

std::vector<FlatFoot> flat_feet(const Motion& motion, const Gait& gait) {
  const double usual = mean_whole_stance(gait);
  std::vector<FlatFoot> out;
  for (const Stance& stance : gait.stances) {
    if (usual == 0) break;
    const Span flat = flat_part(stance, usual);
    const auto first = std::ranges::lower_bound(motion.time, flat.from);
    const auto end = std::ranges::upper_bound(motion.time, flat.to);
    if (first >= end) continue;
    out.push_back({stance.side, static_cast<size_t>(first - motion.time.begin()),
                   static_cast<size_t>(end - motion.time.begin()) - 1});
  }
  return out;
}

}  // namespace metrics
}  // namespace walktrack
