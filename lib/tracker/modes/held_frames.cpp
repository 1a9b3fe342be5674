#include "tracker/modes/held_frames.h"

#include <algorithm>
#include <utility>

namespace walktrack {
inline namespace tracker {

namespace {

// By hand, like the time for which components compete with a track.
constexpr double kHeld = 1.25;  // s
// As far as moments of standing reach back.
constexpr double kKeptStanding = kMoments * kMomentsApart;  // s
// Who stands for longer is let go of at multiples of this. By hand.
constexpr double kLetGo = 10;  // s

size_t frames_of(double seconds, const TrackContext& context) {
  return static_cast<size_t>(frames_in(seconds, context.scene.dt));
}

void hold_more(const TrackContext& context, HeldFrames& held) {
  held.until = std::max(held.until, held.records.size() + frames_of(kHeld, context));
}

}  // namespace

bool holds_frames(const TrackContext& context) {
  return context.competing && context.config.start_again && context.scene.cameras.size() > 1 &&
         context.config.motion.model == MotionKind::kKneed;
}

HeldFrames held_from(const TrackContext& context, uint32_t frame) {
  return {frame, frames_of(kHeld, context)};
}

HeldFrames held_start(const TrackContext& context, uint32_t first_frame,
                      std::vector<FrameRecord> records, bool legs_in_doubt) {
  const size_t until = records.size() + frames_of(kHeld, context);
  return {first_frame, until, std::move(records), legs_in_doubt};
}

void hold(const TrackContext& context, FilteredFrame frame, const Tracking& now, HeldFrames& held) {
  held.records.push_back(std::move(frame.record));
  if (note_standing(context.scene.dt, now, held.records, held.stood)) hold_more(context, held);
  if (!frame.legs_switched || held.legs_in_doubt) return;
  held.legs_in_doubt = true;
  hold_more(context, held);
}

size_t frames_to_keep(const TrackContext& context, const HeldFrames& held) {
  const FrameRecord& newest = held.records.back();
  const size_t period = frames_of(kLetGo, context), next = held.first + held.records.size();
  if (!newest.tracked || newest.modes.standing <= 0.5 || held.first / period != next / period)
    return 0;
  return std::min(held.records.size(), frames_of(kKeptStanding, context));
}

HeldFrames kept_frames(const TrackContext& context, const HeldFrames& held, size_t count) {
  const size_t gone = held.records.size() - count;
  HeldFrames out = held_from(context, held.first + static_cast<uint32_t>(gone));
  out.until += count;
  out.records.assign(held.records.end() - static_cast<long>(count), held.records.end());
  out.stood = held.stood;
  forget_first(gone, out.stood);
  return out;
}

}  // namespace tracker
}  // namespace walktrack
