#include "tracker/start/set_off.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

namespace walktrack {
inline namespace tracker {

namespace {

// So many seconds after the attempt sets off, the moments are compared. By hand.
constexpr double kCompared = 0.6;

// The attempt up to a moment, from which on all particles walk.
Attempt from_moment(const WindowFrames& window, const Attempt& attempt, const Moment& moment,
                    uint64_t number, size_t until) {
  TrackContext context = window.context;
  context.seed += 0x9E3779B97F4A7C15u * number;  // streams of its own
  context.all_set_off = true;
  const auto begin = attempt.records.begin();
  Attempt out{.mode = *moment.track,
              .records = {begin, begin + static_cast<long>(moment.after)},
              .settled = attempt.settled,
              .stood = {{}, moment.after}};
  follow_rest({context, window.frames, window.first}, out, until);
  return out;
}

}  // namespace

Attempt with_best_set_off(const WindowFrames& window, Attempt attempt) {
  if (attempt.stood.sets_off == 0 || !is_tracking(attempt.mode)) return attempt;
  const auto compared = static_cast<size_t>(frames_in(kCompared, window.context.scene.dt));
  const size_t until = std::min(attempt.stood.sets_off + compared, attempt.records.size());
  double most = total_log_likelihood(std::span(attempt.records).first(until));
  std::optional<Attempt> best;
  uint64_t number = 0;
  for (const Moment& moment : std::exchange(attempt.stood.newest, {})) {
    Attempt tried = from_moment(window, attempt, moment, ++number, until);
    const double found = total_log_likelihood(tried);
    if (!is_tracking(tried.mode) || found <= most) continue;
    most = found;
    best = std::move(tried);
  }
  if (!best) return attempt;
  follow_rest(window, *best);
  const bool better =
      is_tracking(best->mode) && total_log_likelihood(*best) > total_log_likelihood(attempt);
  return better ? std::move(*best) : std::move(attempt);
}

}  // namespace tracker
}  // namespace walktrack
