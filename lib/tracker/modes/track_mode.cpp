#include "tracker/modes/track_mode.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "core/log_weights.h"
#include "tracker/frame_likelihood.h"
#include "tracker/modes/loss.h"
#include "tracker/moves/mirror_legs.h"
#include "tracker/smooth/refinement.h"
#include "tracker/start/leg_label_evidence.h"

namespace walktrack {
inline namespace tracker {

namespace {

const WalkerParticle& best_particle(const ParticleSet<WalkerParticle>& set) {
  const auto best = std::max_element(set.log_weights.begin(), set.log_weights.end());
  return set.states[static_cast<size_t>(best - set.log_weights.begin())];
}

std::vector<FrameRecord> start_frame(const TrackContext& context, const SceneEvidence& evidence,
                                     uint32_t frame, TrackMode& mode) {
  Starting& now = std::get<Starting>(mode);
  StartHypotheses& hypotheses = now.hypotheses;
  const bool first = hypotheses.frames() == 0;
  if (!hypotheses.step(first ? first_filter_context(context, now.given) : filter_context(context),
                       evidence, frame)) {
    std::vector<FrameRecord> untracked(static_cast<size_t>(hypotheses.frames()));
    mode = Searching(std::move(now.before));
    return untracked;
  }
  return hypotheses.decided() ? settle(mode) : std::vector<FrameRecord>{};
}

// Whether left and right can be swapped unnoticed: several cameras would show it, and only the
// kneed walker makes phase jumps (tracker/moves/phase_jump.h).
bool labels_may_switch(const TrackContext& context) {
  return context.scene.cameras.size() == 1 && context.config.motion.model == MotionKind::kKneed;
}

// Advances the particles by a frame. If left and right have switched, the legs are mirrored back.
FrameRecord filter_frame(const TrackContext& context, const SceneEvidence& evidence, uint32_t frame,
                         WalkerFilter& filter) {
  const WalkerFilterContext now = filter_context(context);
  std::optional<double> expected;  // place in the stride
  if (labels_may_switch(context)) {
    const auto& set = filter.particles();
    expected = phase_ahead(set.states, normalised_weights(set.log_weights), context.scene.dt);
  }
  FrameRecord record = advance(now, evidence, frame, context.seed, false, filter);
  if (expected && record.tracked && record.modes.standing < 0.5 &&
      label_switched(*expected, record.modes.phase)) {
    mirror_legs(now.motion, filter);
    mirror_legs(context.body(), record);
  }
  return record;
}

FrameRecord track_frame(const TrackContext& context, const SceneEvidence& evidence, uint32_t frame,
                        TrackMode& mode) {
  Tracking& now = std::get<Tracking>(mode);
  FrameRecord record = filter_frame(context, evidence, frame, now.filter);
  // A hypothesis that was rejected at the start is not followed any more, so that its evidence is
  // unknown now.
  record.modes.p_legs_swapped += now.p_legs_swapped * (1 - 2 * record.modes.p_legs_swapped);
  now.mean_pose = record.estimate.pose;
  if (is_lost(context, evidence, record, now.monitor)) {
    record.tracked = false;
    mode = Searching{std::move(now.filter), now.monitor.last_seen};
    return record;
  }
  if (now.monitor.frames_below == 0) see(record.estimate, frame + 1, context.scene.dt, now.monitor);
  record.evidence =
      FrameLikelihood(context.scene, evidence, true).by_term(best_particle(now.filter.particles()));
  return record;
}

}  // namespace

Starting start_around(const TrackContext& context, const DetectedWalk& walk,
                      const std::vector<PhaseRange>& ranges, uint32_t number, Searching before) {
  const uint64_t seed = context.seed + 0xD1B54A32D192ED03u * number;  // streams of its own
  return {StartHypotheses(first_filter_context(context, walk.given).motion, context.config.start,
                          context.config.filter, walk, ranges, seed, context.threads),
          walk.given, std::move(before)};
}

std::vector<FrameRecord> settle(TrackMode& mode) {
  Starting& start = std::get<Starting>(mode);
  const std::vector<FrameRecord> records = start.hypotheses.records();
  std::deque<double> log_likelihoods;
  for (const FrameRecord& record : records) log_likelihoods.push_back(record.mean_log_likelihood);
  Tracking now{.filter = std::move(start.before.filter),
               .monitor = {},
               .p_legs_swapped = records.back().modes.p_legs_swapped,
               .mean_pose = records.back().estimate.pose};
  now.monitor.last_seen = start.before.last_seen;
  now.filter.start(start.hypotheses.resampled());
  begin_watch(std::move(log_likelihoods), now.monitor);
  mode = std::move(now);
  return records;
}

std::vector<FrameRecord> follow(const TrackContext& context, const SceneEvidence& evidence,
                                uint32_t frame, TrackMode& mode) {
  if (!is_tracking(mode)) return start_frame(context, evidence, frame, mode);
  return {track_frame(context, evidence, frame, mode)};
}

void judge(const TrackContext& context, const SceneEvidence& evidence, FrameRecord& record) {
  if (!record.tracked) return;
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
