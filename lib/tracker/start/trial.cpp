#include "tracker/start/trial.h"

#include <cmath>
#include <optional>
#include <utility>

#include "tracker/moves/mirror_legs.h"
#include "tracker/start/attempt.h"
#include "tracker/start/set_off.h"
#include "tracker/start/stride_fit.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Log-odds above which the images agree with the labels of the legs, and below whose negative the
// legs are swapped: set on 80 made walks, four of which were swapped correctly and one wrongly
// (reports/left_and_right.md).
constexpr double kAgreed = 1.5, kSwapped = 0.75;
// The least share of the nats of a detected walk that a trial has to explain. The search takes the
// best of six figures in every frame, a trial follows one walker: of people who walk towards the
// camera, in whose outlines these figures hardly differ, right trials explain up to 4 % less
// (reports/search.md).
constexpr double kNearlyAll = 0.95;
// The log-likelihood of an empty scene, nats.
constexpr double kEmptyScene = 0;
// Nats by which one of two labels has to explain a window better before two cameras. Of 126 starts
// (reports/left_and_right.md) four were nearer, two of them wrong; in the others the labels were 65
// to 1,249 apart, and right.
constexpr double kClearLead = 60;
// So many of these nats count as one: on the same starts the probabilities of swapped legs add up
// to 1.3, and two were swapped.
constexpr double kLeadTemperature = 20;

// A probability after evidence against it, nats.
double updated(double probability, double against) {
  return probability / (probability + std::exp(against) * (1 - probability));
}

// The attempt again, with the legs swapped from the frame on at which its start was decided.
Attempt with_mirrored_legs(const WindowFrames& window, const Attempt& attempt) {
  const WalkerFilterContext filter = filter_context(window.context);
  const auto start = attempt.records.begin();
  const Moment& settled = *attempt.settled;
  Attempt other{.mode = *settled.track,
                .records = {start, start + static_cast<long>(settled.after)},
                .settled = settled};
  for (FrameRecord& record : other.records) mirror_legs(window.context.body(), record);
  mirror_legs(filter.motion, std::get<Tracking>(other.mode).filter);
  follow_rest(window, other);
  return other;
}

void set_p_legs_swapped(double p, Attempt& attempt) {
  std::get<Tracking>(attempt.mode).p_legs_swapped = p;
  for (FrameRecord& record : attempt.records) record.modes.p_legs_swapped = p;
}

Attempt with_labelled_legs(const WindowFrames& window, Attempt first) {
  double p_swapped = std::get<Tracking>(first.mode).p_legs_swapped, odds = first.legs;
  if (odds < kAgreed) {
    Attempt other = with_mirrored_legs(window, first);
    const bool comparable = is_tracking(other.mode);
    if (comparable) odds = 0.5 * (first.legs - other.legs);
    if (comparable && odds < -kSwapped) {
      first = std::move(other);
      p_swapped = 0.5;  // the outlines contain little evidence here
      odds = -odds;
    }
  }
  set_p_legs_swapped(updated(p_swapped, odds), first);
  return first;
}

// From two sides outlines tell the legs apart, but perhaps not in the half second in which a start
// is decided: the window is tracked with swapped legs as well, and the better track is taken.
Attempt with_better_legs(const WindowFrames& window, Attempt first) {
  Attempt other = with_mirrored_legs(window, first);
  if (!is_tracking(other.mode)) return first;
  const double lead = total_log_likelihood(first) - total_log_likelihood(other);
  Attempt better = lead < 0 ? std::move(other) : std::move(first);
  if (std::abs(lead) < kClearLead) better.legs_in_doubt = true;
  set_p_legs_swapped(updated(0.5, std::abs(lead) / kLeadTemperature), better);
  return better;
}

WalkerFilter filter_of(TrackMode mode) {
  if (Searching* searching = std::get_if<Searching>(&mode)) return std::move(searching->filter);
  if (Starting* start = std::get_if<Starting>(&mode)) return std::move(start->before.filter);
  return std::move(std::get<Tracking>(mode).filter);
}

}  // namespace

Trial try_start(const TrackContext& context, const std::deque<SceneEvidence>& window,
                uint32_t first_frame, const DetectedWalk& walk, uint32_t number,
                const Searching& before) {
  const WindowFrames frames{context, window, first_frame};
  Attempt attempt{
      .mode = start_around(context, walk, likely_ranges(context, window, walk), number, before)};
  follow_rest(frames, attempt);
  if (context.scene.cameras.size() > 1) attempt = with_best_set_off(frames, std::move(attempt));
  if (attempt.legs != 0) attempt = with_labelled_legs(frames, std::move(attempt));
  if (is_tracking(attempt.mode) && context.scene.cameras.size() == 2)
    attempt = with_better_legs(frames, std::move(attempt));
  const double detected = walk.score * static_cast<double>(window.size());
  const double least = walk.given ? kEmptyScene : kNearlyAll * detected;
  const double log_likelihood = total_log_likelihood(attempt);
  if (is_searching(attempt.mode) || log_likelihood < least)
    return {Searching{filter_of(std::move(attempt.mode)), before.last_seen}};
  return {.mode = std::move(attempt.mode),
          .records = std::move(attempt.records),
          .log_likelihood = log_likelihood,
          .legs_in_doubt = attempt.legs_in_doubt};
}

}  // namespace tracker
}  // namespace walktrack
