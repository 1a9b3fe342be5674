#include "tracker/start/new_start.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "tracker/overlaps.h"
#include "tracker/start/attempt.h"
#include "tracker/start/set_off.h"
#include "tracker/start/trial.h"

namespace walktrack {
inline namespace tracker {

namespace {

// A start is a draw of a few hundred particles, and may fail like the first one.
constexpr int kTrials = 2;
// Nats by which it has to be better, as of components that turn (tracker/modes/turning.cpp). Where
// it corrected a track (reports/left_and_right.md) it was 220 to 2,200 better.
constexpr double kClearlyBetter = 100;

// The overlap of figure and person falls by more where the track leaves the person's legs
// (reports/left_and_right.md).
constexpr double kOverlapFalls = 0.1;

size_t frames_of(const TrackContext& context, double seconds) {
  return static_cast<size_t>(frames_in(seconds, context.scene.dt));
}

std::vector<FigureFit> fits_with(std::vector<FigureFit> earlier,
                                 std::span<const FrameRecord> records) {
  const std::vector<FigureFit> fits = fits_of(records);
  earlier.insert(earlier.end(), fits.begin(), fits.end());
  return earlier;
}

void remember(const TrackContext& context, std::vector<FigureFit> fits, TrackMode& mode) {
  const size_t most = std::min(fits.size(), frames_of_fall(context.scene.dt));
  fits.erase(fits.begin(), fits.end() - static_cast<long>(most));
  std::get<Tracking>(mode).monitor.fits = std::move(fits);
}

const HeldFrames* held_by(const TrackMode& mode) {
  const Tracking* now = std::get_if<Tracking>(&mode);
  return now && now->held ? &*now->held : nullptr;
}

// The first record after the subject has stood, from which on they walk. Particles that lose the
// subject's legs may stand for a moment, too.
size_t walks_from(const TrackContext& context, std::span<const FrameRecord> records) {
  constexpr double kStands = 0.5;  // s; less counts at the beginning only
  size_t from = 0, standing = 0;
  for (size_t i = 0; i < records.size(); ++i) {
    standing = records[i].modes.standing > 0.5 ? standing + 1 : 0;
    if (standing == i + 1 || standing >= frames_of(context, kStands)) from = i + 1;
  }
  return from;
}

// Where the track walks, by its own records: about a step of them says how fast.
DetectedWalk walk_of(const TrackContext& context, std::span<const FrameRecord> records) {
  constexpr double kStep = 0.6;  // s
  const auto place = [](const FrameRecord& each) -> Eigen::Vector2d {
    return each.estimate.pose.root.head<2>();
  };
  size_t later = std::min(records.size() - 1, frames_of(context, kStep));
  while (later > 1 && !records[later].tracked) --later;
  DetectedWalk walk;
  walk.position = place(records.front());
  walk.velocity =
      (place(records[later]) - walk.position) / (context.scene.dt * static_cast<double>(later));
  walk.score = -std::numeric_limits<double>::infinity();  // the trial is compared with the track
  return walk;
}

void judge_all(const TrackContext& context, const std::deque<SceneEvidence>& frames,
               std::vector<FrameRecord>& records) {
  for (size_t i = 0; i < records.size(); ++i) judge(context, frames[i], records[i]);
}

struct PossibleStart {
  size_t record;  // of the held ones, in which it begins
  DetectedWalk walk;
};

// By the particles' means, before they are refined.
std::optional<PossibleStart> possible_start(const TrackContext& context,
                                            std::span<const FrameRecord> records) {
  const size_t from = walks_from(context, records);
  if (records.size() < from + frames_of(context, context.config.start.seconds) + 1) return {};
  return PossibleStart{from, walk_of(context, records.subspan(from))};
}

// Tracks the held frames from a start of their own. If that explains them better, their records and
// the mode are replaced.
void start_again(const TrackContext& context, const std::deque<SceneEvidence>& frames,
                 const PossibleStart& start, uint32_t& starts, HeldFrames& held, TrackMode& mode) {
  const auto from = static_cast<long>(start.record);
  const std::span walking = std::span(held.records).subspan(start.record);
  const std::deque<SceneEvidence> window(frames.begin() + from, frames.end());
  const auto first_frame = held.first + static_cast<uint32_t>(start.record);
  const Tracking& now = std::get<Tracking>(mode);
  const Searching before{now.filter, now.monitor.last_seen};
  const double own = total_log_likelihood(walking);
  std::optional<Trial> best;
  for (int i = 0; i < kTrials; ++i) {
    Trial trial = try_start(context, window, first_frame, start.walk, ++starts, before);
    if (!is_tracking(trial.mode)) continue;
    const bool as_good = std::abs(trial.log_likelihood - own) < kClearlyBetter;
    if (!best || trial.log_likelihood > best->log_likelihood) best = std::move(trial);
    if (as_good) break;  // there is nothing to be gained
  }
  if (!best || best->log_likelihood < own + kClearlyBetter) return;
  std::move(best->records.begin(), best->records.end(), walking.begin());
  mode = std::move(best->mode);
}

// Tracks the held frames again from other moments in which the subject may have set off. If one
// explains them better, their records and the mode are replaced.
void set_off_better(const TrackContext& context, const std::deque<SceneEvidence>& frames,
                    HeldFrames& held, TrackMode& mode) {
  const size_t sets_off = held.stood.sets_off;
  if (sets_off == 0 || held.lost) return;
  TrackContext alone = context;
  alone.competing = false;
  Attempt best =
      with_best_set_off({alone, frames, held.first}, {.mode = std::move(mode),
                                                      .records = std::move(held.records),
                                                      .stood = std::exchange(held.stood, {})});
  if (best.stood.sets_off != sets_off) held.legs_in_doubt = best.legs_in_doubt;
  mode = std::move(best.mode);
  held.records = std::move(best.records);
  use_particles(context.config.filter.particles, std::get<Tracking>(mode));
}

}  // namespace

bool holding(const TrackMode& mode) { return held_by(mode) != nullptr; }

bool held_enough(const TrackMode& mode) {
  const HeldFrames* held = held_by(mode);
  return held && held->enough();
}

std::vector<FrameRecord> decide_held(const TrackContext& context,
                                     const std::deque<SceneEvidence>& frames, bool more_follow,
                                     uint32_t& starts, TrackMode& mode) {
  Tracking& now = std::get<Tracking>(mode);
  HeldFrames held = *std::exchange(now.held, std::nullopt);
  std::vector<FigureFit> earlier = std::exchange(now.monitor.fits, {});
  set_off_better(context, frames, held, mode);
  std::vector<FrameRecord>& records = held.records;
  const std::optional<PossibleStart> start = possible_start(context, records);
  judge_all(context, frames, records);
  const std::vector<FigureFit> fits = fits_with(earlier, records);
  const double fall = largest_overlap_fall(fits, context.scene.dt, records.size());
  const bool lost = held.lost;
  if (start && (held.legs_in_doubt || lost || fall > kOverlapFalls)) {
    start_again(context, frames, *start, starts, held, mode);
    judge_all(context, frames, records);
  }
  if (lost && !records.back().tracked) {
    mode = Searching{std::move(now.filter), now.monitor.last_seen};
    return std::move(records);
  }
  const size_t kept = more_follow ? frames_to_keep(context, held) : 0;
  if (kept > 0) std::get<Tracking>(mode).held = kept_frames(context, held, kept);
  records.resize(records.size() - kept);
  remember(context, fits_with(std::move(earlier), records), mode);
  return std::move(records);
}

}  // namespace tracker
}  // namespace walktrack
