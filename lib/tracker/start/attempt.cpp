#include "tracker/start/attempt.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "tracker/moves/mirror_legs.h"
#include "tracker/start/leg_label_evidence.h"

namespace walktrack {
inline namespace tracker {

double total_log_likelihood(std::span<const FrameRecord> records) {
  double sum = 0;
  for (const FrameRecord& record : records) sum += record.mean_log_likelihood;
  return sum;
}

double total_log_likelihood(const Attempt& attempt) {
  const double finished = total_log_likelihood(attempt.records);
  const Starting* start = std::get_if<Starting>(&attempt.mode);
  return start ? finished + total_log_likelihood(start->hypotheses.records()) : finished;
}

void follow_rest(const WindowFrames& window, Attempt& attempt, size_t until) {
  TrackContext context = window.context;
  context.competing = false;
  const bool several = context.scene.cameras.size() > 1;
  const size_t end = std::min(until, window.frames.size());
  for (size_t i = attempt.records.size(); i < end && !is_searching(attempt.mode); ++i) {
    std::vector<FrameRecord> records =
        follow(context, window.frames[i], window.first + static_cast<uint32_t>(i), attempt.mode);
    context.all_set_off = false;
    std::move(records.begin(), records.end(), std::back_inserter(attempt.records));
    if (relabel_before_switch(context.body(), attempt.records) && several)
      attempt.legs_in_doubt = true;
    if (!is_tracking(attempt.mode)) continue;
    const Tracking& now = std::get<Tracking>(attempt.mode);
    if (several) note_standing(context.scene.dt, now, attempt.records, attempt.stood);
    if (!attempt.settled) attempt.settled = moment_of(now, attempt.records.size());
  }
  if (is_tracking(attempt.mode) && !several)
    attempt.legs = legs_log_odds(context.scene, window.frames, attempt.records);
}

}  // namespace tracker
}  // namespace walktrack
