#include "tracker/tracker.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/conventions.h"

namespace walktrack {

namespace {

constexpr double kUsualSpeed = 1.25;  // m/s
// Walkers that explain an image no better than this share of what a stiff figure does are lost:
// where a person is a few dozen pixels high, a figure does nearly as well as the walker itself.
constexpr double kFigureShare = 0.9;

TrackerConfig to_scale(TrackerConfig config, double height) {
  config.motion = to_scale(config.motion, height);
  return config;
}

double total_support(const std::vector<FrameRecord>& records) {
  double sum = 0;
  for (const FrameRecord& record : records) sum += record.support;
  return sum;
}

}  // namespace

Tracker::Tracker(TrackerScene scene, const GaitPrior& prior, const TrackerConfig& config,
                 uint64_t seed, int threads)
    : scene_(std::move(scene)),
      prior_(prior),
      config_(to_scale(config, scene_.model.body.subject.height)),
      seed_(seed),
      threads_(threads),
      moves_(make_motion_model(config_.motion.model, scene_.model, prior)),
      frame_scale_(noise_scale(*moves_, config_.motion, scene_.model, scene_.dt)),
      markov_(markov_steps(*moves_, config_.motion, scene_.dt)),
      figures_(scene_.model, prior),
      filter_(config.filter, seed, threads) {}

std::vector<FrameRecord> Tracker::push(const SceneEvidence& evidence) {
  std::vector<FrameRecord> out;
  consume(evidence, out);
  return out;
}

std::vector<FrameRecord> Tracker::finish() {
  std::vector<FrameRecord> out;
  if (mode_ == Mode::kStarting) settle(out);
  out.resize(out.size() + window_.size());
  window_.clear();
  return out;
}

TrackerState Tracker::state() const {
  return {frame_,        starts_,        filter_.state(), last_seen_, supports_,
          frames_below_, frames_beaten_, losses_,         doubt_};
}

void Tracker::resume(TrackerState state) {
  mode_ = Mode::kTracking;
  scene_.initial.reset();  // used up
  frame_ = state.frame;
  starts_ = state.starts;
  filter_.resume(std::move(state.filter));
  last_seen_ = state.last_seen;
  supports_ = std::move(state.supports);
  frames_below_ = state.frames_below;
  frames_beaten_ = state.frames_beaten;
  losses_ = state.losses;
  doubt_ = state.doubt;
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

void Tracker::search(const SceneEvidence& evidence, std::vector<FrameRecord>& out) {
  if (scene_.initial) {
    if (frame_ < static_cast<uint32_t>(scene_.initial_frame)) {
      ++frame_;
      out.emplace_back();
      return;
    }
    begin(*std::exchange(scene_.initial, std::nullopt), scene_.initial_phase);
    return compete(evidence, out);
  }
  candidates_.emplace_back();
  window_.push_back(evidence);
  if (static_cast<int>(window_.size()) < frames_in(config_.sighting.window, scene_.dt)) return;
  const auto window_score = [&](size_t frame, const Eigen::Vector2d& place,
                                const Eigen::Vector2d& velocity) {
    return place_score(scene_, window_[frame], figures_.at(velocity.norm()), place,
                       std::atan2(velocity.y(), velocity.x()));
  };
  const WindowEnds ends = window_ends(window_.size());
  const auto sighting =
      find_walk({window_.size(), candidates(ends.early), candidates(ends.late)}, window_score,
                scene_.dt, camera_centre(scene_.cameras[0]).head<2>(), config_.sighting, threads_);
  if (sighting && within_reach(sighting->position, frame_) && attempt(*sighting, out)) return;
  window_.pop_front();
  candidates_.pop_front();
  ++frame_;
  out.emplace_back();
}

// Where somebody may stand in a frame of the window.
const std::vector<Place>& Tracker::candidates(size_t index) {
  if (places_.empty())
    places_ = standing_places(scene_.cameras, scene_.model.body.subject.height, config_.sighting);
  std::optional<std::vector<Place>>& found = candidates_[index];
  if (found) return *found;
  const auto score = [&](const Eigen::Vector2d& place) {
    if (!within_reach(place, frame_ + static_cast<uint32_t>(index))) return 0.0;
    // Half of the figures, half a step, will do for a first look.
    const std::span<const Pose> figures = figures_.at(kUsualSpeed);
    return place_score(scene_, window_[index], figures.first(figures.size() / 2), place,
                       side_on_heading(scene_.cameras[0], place));
  };
  found = find_figures(score, places_, config_.sighting, threads_);
  return *found;
}

// Tracks the window's frames from a sighting; false, and nothing has happened, if the track
// explains them worse than the straight walk of mere figures that it came from.
bool Tracker::attempt(const Sighting& sighting, std::vector<FrameRecord>& out) {
  const uint32_t first_frame = frame_;
  const auto seen_before = last_seen_;
  const int losses_before = losses_;
  std::vector<FrameRecord> tried;
  begin(sighting, std::nullopt);
  for (const SceneEvidence& each : window_) {
    if (mode_ == Mode::kSearching) break;
    consume(each, tried);
  }
  const double support = total_support(tried) + (contest_ ? total_support(contest_->records()) : 0);
  if (mode_ != Mode::kSearching && support >= sighting.score * double(window_.size())) {
    window_.clear();
    candidates_.clear();
    std::move(tried.begin(), tried.end(), std::back_inserter(out));
    return true;
  }
  mode_ = Mode::kSearching;
  frame_ = first_frame;
  last_seen_ = seen_before;
  losses_ = losses_before;
  contest_.reset();
  return false;
}

WalkerFilterContext Tracker::context(bool first) const {
  const NoiseScale scale = first ? start_scale(config_.start, frame_scale_) : frame_scale_;
  return {scene_,
          {scene_.model, prior_, *moves_, config_.motion, scale, markov_, scene_.dt},
          config_.samples,
          threads_,
          config_.model_error};
}

void Tracker::begin(const Sighting& sighting, std::optional<double> stride_phase) {
  const uint64_t seed = seed_ + 0xD1B54A32D192ED03u * ++starts_;  // streams of its own
  contest_.emplace(context(true).motion, config_.start, config_.filter, sighting, stride_phase,
                   seed, threads_);
  mode_ = Mode::kStarting;
}

void Tracker::compete(const SceneEvidence& evidence, std::vector<FrameRecord>& out) {
  const bool explained = contest_->step(context(contest_->frames() == 0), evidence, frame_);
  ++frame_;
  if (!explained) {
    out.resize(out.size() + static_cast<size_t>(contest_->frames()));  // frames stay untracked
    contest_.reset();
    mode_ = Mode::kSearching;
    return;
  }
  if (contest_->decided()) settle(out);
}

// What is left of the contest becomes one set of particles.
void Tracker::settle(std::vector<FrameRecord>& out) {
  filter_.start(contest_->survivors());
  supports_.clear();
  for (const FrameRecord& record : contest_->records()) {
    supports_.push_back(record.support);
    out.push_back(record);
  }
  doubt_ = contest_->records().back().modes.exchanged;
  contest_.reset();
  mode_ = Mode::kTracking;
  frames_below_ = frames_beaten_ = 0;
}

void Tracker::track(const SceneEvidence& evidence, std::vector<FrameRecord>& out) {
  FrameRecord record = advance(context(false), evidence, frame_, seed_, false, filter_);
  ++frame_;
  // Whoever lost the start is not followed any more: nothing can tell what it would say now.
  record.modes.exchanged += doubt_ * (1 - 2 * record.modes.exchanged);
  if (record.filter.all_dead || fading(record.support, figure_score(evidence, record.estimate))) {
    record.tracked = false;
    ++losses_;
    supports_.clear();
    mode_ = Mode::kSearching;
  }
  if (mode_ == Mode::kTracking && frames_below_ == 0) see(record.estimate);
  out.push_back(std::move(record));
}

// Remembers where the walker is and how they have been going on: a frame's own speed trembles.
void Tracker::see(const FrameEstimate& estimate) {
  constexpr double kMemory = 1;  // s
  const Pose& pose = estimate.pose;
  const Eigen::Vector2d now =
      estimate.speed * Eigen::Vector2d(std::cos(pose.heading), std::sin(pose.heading));
  const Eigen::Vector2d before = last_seen_ ? last_seen_->velocity : now;
  const double kept = std::exp(-scene_.dt / kMemory);
  last_seen_ = {pose.root.head<2>(), kept * before + (1 - kept) * now, frame_};
}

// Whether a walker who was lost can be at a place: not far from where they were going.
bool Tracker::within_reach(const Eigen::Vector2d& place, uint32_t frame) const {
  if (!last_seen_) return true;
  constexpr double kNear = 0.5;   // m
  constexpr double kStray = 0.8;  // m/s: they may stop or turn aside
  const double elapsed = scene_.dt * (frame - last_seen_->frame);
  if (elapsed > config_.seek) return true;
  const Eigen::Vector2d expected = last_seen_->position + elapsed * last_seen_->velocity;
  return (place - expected).norm() < kNear + kStray * elapsed;
}

// What a figure out of the gait's book would score where the walker is believed to be, whichever
// way it faces.
double Tracker::figure_score(const SceneEvidence& evidence, const FrameEstimate& estimate) const {
  constexpr int kHeadings = 6;
  double best = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < kHeadings; ++k) {
    const double heading = estimate.pose.heading + 2 * kPi * k / kHeadings;
    best = std::max(best, place_score(scene_, evidence, figures_.at(kUsualSpeed),
                                      estimate.pose.root.head<2>(), heading));
  }
  return best;
}

// Whether the track is lost: for a while the likelihood has been far below its own recent median,
// as that of a hidden walker is, or for a shorter while a stiff figure has done better.
bool Tracker::fading(double support, double figure) {
  std::vector<double> past(supports_.begin(), supports_.end());
  std::nth_element(past.begin(), past.begin() + static_cast<long>(past.size() / 2), past.end());
  const double least =
      std::max(config_.lost_below * past[past.size() / 2], config_.sighting.least_score);
  const bool beaten = figure > least && support < kFigureShare * figure;
  const bool below = support < least;
  frames_beaten_ = beaten ? frames_beaten_ + 1 : 0;
  frames_below_ = below || beaten ? frames_below_ + 1 : 0;
  // Bad frames do not become the measure of good ones.
  if (frames_below_ == 0) supports_.push_back(support);
  if (static_cast<int>(supports_.size()) > frames_in(config_.recall, scene_.dt))
    supports_.pop_front();
  return frames_below_ >= frames_in(config_.lost_after, scene_.dt) ||
         frames_beaten_ >= frames_in(config_.beaten_after, scene_.dt);
}

}  // namespace walktrack
