#include "tracker/start/new_start.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "tracker/start/trial.h"

namespace walktrack {
inline namespace tracker {

namespace {

// A start is a draw of a few hundred particles, and may fail like the first one.
constexpr int kTrials = 2;
// Nats by which it has to be better, as of components that turn (tracker/modes/turning.cpp). Where
// it corrected a track (reports/left_and_right.md) it was 220 to 2,200 better.
constexpr double kClearlyBetter = 100;

const HeldFrames* held_by(const TrackMode& mode) {
  const Tracking* now = std::get_if<Tracking>(&mode);
  return now && now->held ? &*now->held : nullptr;
}

// The first record after the subject has stood, from which on they walk.
size_t walks_from(std::span<const FrameRecord> records) {
  const auto stands = [](const FrameRecord& each) { return each.modes.standing > 0.5; };
  const auto last = std::find_if(records.rbegin(), records.rend(), stands);
  return static_cast<size_t>(records.rend() - last);
}

// Where the track walks, by its own records: about a step of them says how fast.
DetectedWalk walk_of(const TrackContext& context, std::span<const FrameRecord> records) {
  constexpr double kStep = 0.6;  // s
  const auto place = [](const FrameRecord& each) -> Eigen::Vector2d {
    return each.estimate.pose.root.head<2>();
  };
  const size_t later =
      std::min(records.size() - 1, static_cast<size_t>(frames_in(kStep, context.scene.dt)));
  DetectedWalk walk;
  walk.position = place(records.front());
  walk.velocity =
      (place(records[later]) - walk.position) / (context.scene.dt * static_cast<double>(later));
  walk.score = -std::numeric_limits<double>::infinity();  // the trial is compared with the track
  return walk;
}

}  // namespace

bool holding(const TrackMode& mode) { return held_by(mode) != nullptr; }

bool held_enough(const TrackMode& mode) {
  const HeldFrames* held = held_by(mode);
  return held && held->enough();
}

std::vector<FrameRecord> decide_held(const TrackContext& context,
                                     const std::deque<SceneEvidence>& frames, uint32_t& starts,
                                     TrackMode& mode) {
  Tracking& now = std::get<Tracking>(mode);
  HeldFrames held = *std::exchange(now.held, std::nullopt);
  std::vector<FrameRecord>& records = held.records;
  const size_t from = walks_from(records);
  const auto least = static_cast<size_t>(frames_in(context.config.start.seconds, context.scene.dt));
  if (!held.legs_in_doubt || records.size() < from + least + 1) return std::move(records);
  const std::span walking = std::span(records).subspan(from);
  const std::deque<SceneEvidence> window(frames.begin() + static_cast<long>(from), frames.end());
  const DetectedWalk walk = walk_of(context, walking);
  const auto first_frame = held.first + static_cast<uint32_t>(from);
  const Searching before{now.filter, now.monitor.last_seen};
  std::optional<Trial> best;
  for (int i = 0; i < kTrials; ++i) {
    Trial trial = try_start(context, window, first_frame, walk, ++starts, before);
    if (is_tracking(trial.mode) && (!best || trial.log_likelihood > best->log_likelihood))
      best = std::move(trial);
  }
  if (!best || best->log_likelihood < total_log_likelihood(walking) + kClearlyBetter)
    return std::move(records);
  std::move(best->records.begin(), best->records.end(), walking.begin());
  mode = std::move(best->mode);
  return std::move(records);
}

}  // namespace tracker
}  // namespace walktrack
