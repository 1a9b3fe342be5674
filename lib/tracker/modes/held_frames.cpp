#include "tracker/modes/held_frames.h"

#include <algorithm>
#include <utility>

namespace walktrack {
inline namespace tracker {

namespace {

// By hand, like the time for which components compete with a track.
constexpr double kHeld = 1.25;  // s

size_t more_frames(const TrackContext& context) {
  return static_cast<size_t>(frames_in(kHeld, context.scene.dt));
}

}  // namespace

bool holds_frames(const TrackContext& context) {
  return context.competing && context.config.start_again && context.scene.cameras.size() > 1 &&
         context.config.motion.model == MotionKind::kKneed;
}

HeldFrames held_from(const TrackContext& context, uint32_t frame) {
  return {frame, more_frames(context)};
}

HeldFrames held_start(const TrackContext& context, uint32_t first_frame,
                      std::vector<FrameRecord> records, bool legs_in_doubt) {
  const size_t until = records.size() + more_frames(context);
  return {first_frame, until, std::move(records), legs_in_doubt};
}

void hold(const TrackContext& context, FilteredFrame frame, HeldFrames& held) {
  held.records.push_back(std::move(frame.record));
  if (!frame.legs_switched || held.legs_in_doubt) return;
  held.legs_in_doubt = true;
  held.until = std::max(held.until, held.records.size() + more_frames(context));
}

}  // namespace tracker
}  // namespace walktrack
