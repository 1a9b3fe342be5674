#include "tracker/modes/stood_moments.h"

#include "tracker/modes/track_mode.h"

namespace walktrack {
inline namespace tracker {

Moment moment_of(const Tracking& now, size_t after) {
  return {std::make_shared<const Tracking>(
              Tracking{now.filter, now.monitor, now.p_legs_swapped, now.mean_pose, now.speed}),
          after};
}

bool note_standing(double dt, const Tracking& now, std::span<const FrameRecord> records,
                   StoodMoments& stood) {
  if (stood.sets_off > 0) return false;
  const size_t count = records.size();
  std::deque<Moment>& newest = stood.newest;
  if (records.back().modes.standing <= 0.5) {
    if (!newest.empty()) stood.sets_off = count;
    return stood.sets_off > 0;
  }
  const auto apart = static_cast<size_t>(frames_in(kMomentsApart, dt));
  if (!newest.empty() && count - newest.back().after < apart) return false;
  newest.push_back(moment_of(now, count));
  if (newest.size() > kMoments) newest.pop_front();
  return false;
}

void forget_first(size_t frames, StoodMoments& stood) {
  std::erase_if(stood.newest, [&](const Moment& each) { return each.after <= frames; });
  for (Moment& each : stood.newest) each.after -= frames;
}

}  // namespace tracker
}  // namespace walktrack
