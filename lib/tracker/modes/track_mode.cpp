#include "tracker/modes/track_mode.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "core/log_weights.h"
#include "tracker/modes/loss.h"
#include "tracker/smooth/refinement.h"
#include "tracker/start/leg_label_evidence.h"

namespace walktrack {
inline namespace tracker {

namespace {

std::vector<FrameRecord> start_frame(const TrackContext& context, const SceneEvidence& evidence,
                                     uint32_t frame, TrackMode& mode) {
  Starting& now = std::get<Starting>(mode);
  StartHypotheses& hypotheses = now.hypotheses;
  const bool first = hypotheses.frames() == 0;
  if (!hypotheses.step(first ? first_filter_context(context) : filter_context(context), evidence,
                       frame)) {
    std::vector<FrameRecord> untracked(static_cast<size_t>(hypotheses.frames()));
    mode = Searching(std::move(now.before));
    return untracked;
  }
  if (!hypotheses.decided()) return {};
  std::vector<FrameRecord> records = settle(mode);
  if (!holds_frames(context)) return records;
  const auto first_frame = static_cast<uint32_t>(frame + 1 - records.size());
  std::get<Tracking>(mode).held = held_start(context, first_frame, std::move(records), false);
  return {};
}

// A hypothesis that was rejected at the start is not followed any more, so that its evidence is
// unknown now.
void allow_for_start(double p_legs_swapped, FrameRecord& record) {
  record.modes.p_legs_swapped += p_legs_swapped * (1 - 2 * record.modes.p_legs_swapped);
}

void note_pose(const FrameRecord& record, Tracking& now) {
  now.mean_pose = record.estimate.pose;
  now.speed = record.estimate.speed;
}

// The component, whose newest frame is number `frame`, replaces the track.
void replace(const TrackContext& context, const TurningComponent& component, uint32_t frame,
             Tracking& now) {
  now.filter.resume(component.filter.state());
  note_pose(component.records.back(), now);
  now.monitor.frames_below = now.monitor.frames_outscored = now.monitor.frames_off = 0;
  see(component.records.back().estimate, frame + 1, context.scene.dt, now.monitor);
}

bool components_may_turn(const TrackContext& context) {
  return context.competing && turning_components(context.config.motion, context.scene.model.path,
                                                 context.scene.cameras.size()) > 0;
}

std::vector<FrameRecord> track_frame(const TrackContext& context, const SceneEvidence& evidence,
                                     uint32_t frame, TrackMode& mode) {
  Tracking& now = std::get<Tracking>(mode);
  if (!now.turning && components_may_turn(context))
    now.turning = components_that_turn(context, now.filter, frame);
  FilteredFrame filtered =
      filter_frame(context, filter_context(context), evidence, frame, context.seed, now.filter);
  FrameRecord& record = filtered.record;
  allow_for_start(now.p_legs_swapped, record);
  if (is_lost(context, evidence, frame, record, now.monitor)) {
    record.tracked = false;
    record.evidence.clear();
    if (now.held) {  // a new start among them may know better
      now.held->records.push_back(std::move(record));
      now.held->lost = true;
      return {};
    }
    if (!now.turning) now.turning = TurningTrial{};
    step(context, evidence, frame, std::move(record), *now.turning);
    const bool found = winner(*now.turning) != nullptr;  // the subject has turned
    std::vector<FrameRecord> records = decide_turning(context, frame, now);
    if (!found) mode = Searching{std::move(now.filter), now.monitor.last_seen};
    return records;
  }
  note_pose(record, now);
  if (now.monitor.frames_below == 0) see(record.estimate, frame + 1, context.scene.dt, now.monitor);
  if (holds_frames(context)) {
    if (!now.held) now.held = held_from(context, frame);
    hold(context, std::move(filtered), now, *now.held);
    return {};
  }
  if (!now.turning) return {std::move(record)};
  if (!step(context, evidence, frame, std::move(record), *now.turning)) return {};
  return decide_turning(context, frame, now);
}

bool judged(const FrameRecord& record) { return !record.fit.overlap.empty(); }

}  // namespace

Starting start_around(const TrackContext& context, const DetectedWalk& walk,
                      const std::vector<PhaseRange>& ranges, uint32_t number, Searching before) {
  const uint64_t seed = context.seed + 0xD1B54A32D192ED03u * number;  // streams of its own
  return {StartHypotheses(first_filter_context(context).motion, context.config.start,
                          context.config.filter, walk, ranges, seed, context.threads),
          std::move(before)};
}

std::vector<FrameRecord> settle(TrackMode& mode) {
  Starting& start = std::get<Starting>(mode);
  std::vector<FrameRecord> records = start.hypotheses.records();
  std::deque<double> log_likelihoods;
  for (const FrameRecord& record : records) log_likelihoods.push_back(record.mean_log_likelihood);
  Tracking now{.filter = std::move(start.before.filter),
               .monitor = {},
               .p_legs_swapped = records.back().modes.p_legs_swapped,
               .mean_pose = records.back().estimate.pose,
               .speed = records.back().estimate.speed};
  now.monitor.last_seen = start.before.last_seen;
  now.filter.start(start.hypotheses.resampled());
  begin_watch(std::move(log_likelihoods), now.monitor);
  mode = std::move(now);
  return records;
}

std::vector<FrameRecord> follow(const TrackContext& context, const SceneEvidence& evidence,
                                uint32_t frame, TrackMode& mode) {
  if (!is_tracking(mode)) return start_frame(context, evidence, frame, mode);
  return track_frame(context, evidence, frame, mode);
}

std::vector<FrameRecord> decide_turning(const TrackContext& context, uint32_t frame,
                                        Tracking& now) {
  if (!now.turning) return {};
  TurningTrial trial = std::move(*now.turning);
  now.turning.reset();
  TurningComponent* component = winner(trial);
  if (component == nullptr) return std::move(trial.records);
  replace(context, *component, frame, now);
  for (FrameRecord& record : component->records) allow_for_start(now.p_legs_swapped, record);
  return std::move(component->records);
}

void judge(const TrackContext& context, const SceneEvidence& evidence, FrameRecord& record) {
  if (!record.tracked || judged(record)) return;
  if (context.config.estimate == EstimateKind::kMap)
    refine(context.scene, evidence, context.threads, record);
  record.fit = figure_fit(context.scene, evidence, record.estimate.pose);
  record.names = names_in_frame(context.scene, evidence, record.estimate.pose);
}

Eigen::Vector2d mean_place(const Tracking& now) {
  const auto& set = now.filter.particles();
  const std::vector<double> weights = normalised_weights(set.log_weights);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (size_t i = 0; i < weights.size(); ++i) sum += weights[i] * set.states[i].pose.root.head<2>();
  return sum;
}

void use_particles(int count, Tracking& now) {
  const auto& set = now.filter.particles();
  if (set.states.size() == static_cast<size_t>(count)) return;
  std::vector<uint32_t> chosen(static_cast<size_t>(count));
  systematic_resample(set.log_weights, 0.5, chosen);
  std::vector<WalkerParticle> states;
  for (const uint32_t i : chosen) states.push_back(set.states[i]);
  now.filter.start(std::move(states));
}

}  // namespace tracker
}  // namespace walktrack
