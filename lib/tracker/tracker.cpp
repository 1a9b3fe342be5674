#include "tracker/tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/conventions.h"
#include "core/log_weights.h"
#include "tracker/frame_likelihood.h"
#include "tracker/leg_label_evidence.h"
#include "tracker/moves/mirror_legs.h"

namespace walktrack {

namespace {

// What is left of a video is searched from so many seconds on: as long as start
// hypotheses compete.
constexpr double kShortestWindow = 0.5;

// Whether a figure lies on somebody whose keypoints are seen in any camera; nullopt where nobody's
// are.
std::optional<bool> on_somebody(const TrackerScene& scene, const SceneEvidence& evidence,
                                const PosedBody& figure) {
  std::optional<bool> out;
  for (size_t c = 0; c < evidence.size(); ++c) {
    const auto found =
        KeypointTerm::on_somebody(scene.observation, evidence[c], scene.cameras[c], figure);
    if (found) out = out.value_or(false) || *found;
  }
  return out;
}

const WalkerParticle& best_particle(const ParticleSet<WalkerParticle>& set) {
  const auto best = std::max_element(set.log_weights.begin(), set.log_weights.end());
  return set.states[static_cast<size_t>(best - set.log_weights.begin())];
}

}  // namespace

SubjectModel::SubjectModel(const BodyModel& model, const GaitPrior& prior,
                           const MotionConfig& config, double dt)
    : motion(to_scale(config, model.body.subject.height)),
      moves(make_motion_model(motion.model, model, prior)),
      frame_scale(noise_scale(*moves, motion, model, dt)),
      markov(markov_steps(*moves, motion, dt)),
      figures(model, prior) {
  // Other models do without a walker, or have none that could rest.
  if (motion.standing && motion.model == MotionKind::kKneed)
    standing = standing_process(*moves, motion, dt);
}

Tracker::Tracker(TrackerScene scene, const GaitPrior& prior, const TrackerConfig& config,
                 uint64_t seed, int threads)
    : scene_(std::move(scene)),
      prior_(prior),
      config_(config),
      seed_(seed),
      threads_(threads),
      kit_(scene_.model, prior, config.motion, scene_.dt),
      filter_(config.filter, seed, threads) {}

std::vector<FrameRecord> Tracker::push(const SceneEvidence& evidence) {
  std::vector<FrameRecord> out;
  consume(evidence, out);
  return out;
}

std::vector<FrameRecord> Tracker::finish() {
  std::vector<FrameRecord> out;
  if (scene_.initial && window_.size() > 1) start_as_given(out);
  // The window is what is left, and less and less of it.
  while (mode_ == Mode::kSearching && !scene_.initial &&
         static_cast<int>(window_.size()) >= frames_in(kShortestWindow, scene_.dt)) {
    config_.detector.window = scene_.dt * double(window_.size());
    const SceneEvidence newest = std::move(window_.back());
    window_.pop_back();
    candidates_.pop_back();
    search(newest, out);
  }
  if (mode_ == Mode::kStarting) settle(out);
  out.resize(out.size() + waiting_.size() + window_.size());
  waiting_.clear();
  window_.clear();
  return out;
}

TrackerState Tracker::state() const {
  return {frame_, starts_, filter_.state(), monitor_, losses_, p_legs_swapped_, stature_};
}

void Tracker::resume(TrackerState state) {
  mode_ = Mode::kTracking;
  scene_.initial.reset();  // used up
  frame_ = state.frame;
  starts_ = state.starts;
  filter_.resume(std::move(state.filter));
  monitor_ = std::move(state.monitor);
  losses_ = state.losses;
  p_legs_swapped_ = state.p_legs_swapped;
  stature_ = state.stature;
  if (stature_) set_height(stature_->height);
}

Eigen::Vector2d Tracker::mean_place() const {
  const auto& set = filter_.particles();
  const std::vector<double> weights = normalised_weights(set.log_weights);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (size_t i = 0; i < weights.size(); ++i) sum += weights[i] * set.states[i].pose.root.head<2>();
  return sum;
}

void Tracker::use_particles(int count) {
  config_.filter.particles = count;
  const auto& set = filter_.particles();
  if (mode_ != Mode::kTracking || set.states.size() == static_cast<size_t>(count)) return;
  std::vector<uint32_t> chosen(static_cast<size_t>(count));
  systematic_resample(set.log_weights, 0.5, chosen);
  std::vector<WalkerParticle> states;
  for (const uint32_t i : chosen) states.push_back(set.states[i]);
  filter_.start(std::move(states));
}

void Tracker::consume(const SceneEvidence& evidence, std::vector<FrameRecord>& out) {
  switch (mode_) {
    case Mode::kSearching:
      return search(evidence, out);
    case Mode::kStarting:
      return compete(evidence, out);
    case Mode::kTracking:
      return track(evidence, out);
  }
}

WalkerFilterContext Tracker::context(bool first) const {
  MotionConfig motion = kit_.motion;
  const NoiseScale scale =
      first ? start_scale(config_.start, *kit_.moves, motion, kit_.frame_scale) : kit_.frame_scale;
  if (first && start_is_given_) motion.start_position_sd = motion.given_position_sd;
  return {scene_,
          {scene_.model, prior_, *kit_.moves, motion, scale, kit_.markov, scene_.dt,
           kit_.standing ? &*kit_.standing : nullptr},
          config_.samples,
          threads_,
          config_.model_error};
}

void Tracker::begin(const DetectedWalk& detected, std::optional<double> stride_phase) {
  const uint64_t seed = seed_ + 0xD1B54A32D192ED03u * ++starts_;  // streams of its own
  start_is_given_ = detected.given;
  hypotheses_.emplace(context(true).motion, config_.start, config_.filter, detected, stride_phase,
                      seed, threads_);
  mode_ = Mode::kStarting;
}

void Tracker::compete(const SceneEvidence& evidence, std::vector<FrameRecord>& out) {
  const bool explained = hypotheses_->step(context(hypotheses_->frames() == 0), evidence, frame_);
  if (window_.empty()) hypotheses_frames_.push_back(evidence);
  ++frame_;
  if (!explained) {
    hypotheses_frames_.clear();
    out.resize(out.size() + static_cast<size_t>(hypotheses_->frames()));  // frames stay untracked
    hypotheses_.reset();
    mode_ = Mode::kSearching;
    return;
  }
  if (hypotheses_->decided()) settle(out);
}

// What is left of the start hypotheses becomes one set of particles.
void Tracker::settle(std::vector<FrameRecord>& out) {
  filter_.start(hypotheses_->resampled());
  std::deque<double> log_likelihoods;
  for (const FrameRecord& record : hypotheses_->records()) {
    log_likelihoods.push_back(record.mean_log_likelihood);
    out.push_back(record);
    if (hypotheses_frames_.empty()) continue;
    refine(hypotheses_frames_.front(), out.back());
    hypotheses_frames_.pop_front();
  }
  p_legs_swapped_ = hypotheses_->records().back().modes.p_legs_swapped;
  mean_pose_ = hypotheses_->records().back().estimate.pose;
  hypotheses_.reset();
  mode_ = Mode::kTracking;
  begin_watch(std::move(log_likelihoods), monitor_);
}

// Whether a set that takes one leg for the other goes unnoticed: several cameras see it, and only
// the kneed walker reads poses anew (tracker/moves/phase_jump.h).
bool Tracker::labels_may_switch() const {
  return scene_.cameras.size() == 1 && config_.motion.model == MotionKind::kKneed;
}

// Takes the particles through a frame. Where left and right have switched, legs are mirrored back.
FrameRecord Tracker::follow(const SceneEvidence& evidence) {
  const WalkerFilterContext now = context(false);
  std::optional<double> expected;  // place in the stride
  if (labels_may_switch()) {
    const auto& set = filter_.particles();
    expected = phase_ahead(set.states, normalised_weights(set.log_weights), scene_.dt);
  }
  FrameRecord record = advance(now, evidence, frame_, seed_, false, filter_);
  if (expected && record.tracked && record.modes.standing < 0.5 &&
      label_switched(*expected, record.modes.phase)) {
    mirror_legs(now.motion, filter_);
    mirror_legs(body(), record);
  }
  return record;
}

// While a window of frames is tried, what is tried is what the particles say: the window is refined
// when it has been decided who walks there, and which leg is which. What comes of it is then judged
// by its frame's evidence, which is gone when frames are smoothed.
void Tracker::refine(const SceneEvidence& evidence, FrameRecord& record) const {
  if (!window_.empty() || !record.tracked) return;
  if (config_.estimate == EstimateKind::kMap) walktrack::refine(scene_, evidence, threads_, record);
  record.fit = figure_fit(scene_, evidence, record.estimate.pose);
  record.names = names_in_frame(scene_, evidence, record.estimate.pose);
}

void Tracker::track(const SceneEvidence& evidence, std::vector<FrameRecord>& out) {
  FrameRecord record = follow(evidence);
  ++frame_;
  // A hypothesis that lost the start is not followed any more, so its evidence is unknown now.
  record.modes.p_legs_swapped += p_legs_swapped_ * (1 - 2 * record.modes.p_legs_swapped);
  if (is_lost(evidence, record)) {
    record.tracked = false;
    ++losses_;
    mode_ = Mode::kSearching;
  }
  if (mode_ == Mode::kTracking && monitor_.frames_below == 0)
    see(record.estimate, frame_, scene_.dt, monitor_);
  mean_pose_ = record.estimate.pose;
  if (record.tracked)
    record.evidence =
        FrameLikelihood(scene_, evidence, true).by_term(best_particle(filter_.particles()));
  refine(evidence, record);
  out.push_back(std::move(record));
}

// Whether a walker who was lost can be at a place.
bool Tracker::within_reach(const Eigen::Vector2d& place, uint32_t frame) const {
  return is_within_reach(config_.monitor, monitor_, place, frame, scene_.dt);
}

// What the monitor says of a frame; it takes in all that there is to say, lost or not.
bool Tracker::is_lost(const SceneEvidence& evidence, const FrameRecord& record) {
  if (record.filter.all_dead) return true;
  const double figure = figure_score(evidence, record.estimate);
  if (is_fading(config_.monitor, config_.detector.least_score, scene_.dt,
                record.mean_log_likelihood, figure, monitor_))
    return true;
  const PosedBody posed(body(), record.estimate.pose);
  return is_off_people(config_.monitor, scene_.dt, on_somebody(scene_, evidence, posed), monitor_);
}

}  // namespace walktrack
