#include "tracker/tracker.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "core/log_weights.h"
#include "tracker/course.h"

namespace walktrack {

namespace {

// A hypothesis this many nats behind the best has lost (odds of 1 to 3 million).
constexpr double kHopeless = 15;
// Share of the filter's moves that change the course, the others change the frame's noise.
constexpr double kCourseMoves = 0.3;
constexpr double kUsualSpeed = 1.25;  // m/s
// Walkers that explain an image no better than this share of what a stiff figure does are lost:
// where a person is a few dozen pixels high, a figure does nearly as well as the walker itself.
constexpr double kFigureShare = 0.9;

// Walking people keep their hips up: below .85 of the leg's length the pose becomes improbable,
// 1 % of it counting as one standard deviation (the prior's longest steps lower the hip to .83).
double log_uprightness(const BodyModel& model, const Pose& pose) {
  const double below = 0.85 - pose.root.z() / leg_length(model.body.lengths);
  return below > 0 ? -0.5 * (below / 0.01) * (below / 0.01) : 0;
}

int frames_in(double seconds, double dt) {
  return std::max(2, static_cast<int>(std::lround(seconds / dt)));
}

}  // namespace

Tracker::Tracker(TrackerScene scene, const GaitPrior& prior, const TrackerConfig& config,
                 uint64_t seed, int threads)
    : scene_(std::move(scene)),
      prior_(prior),
      config_(config),
      seed_(seed),
      threads_(threads),
      frame_scale_(noise_scale(config.motion, scene_.model, scene_.dt)),
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
  if (places_.empty())
    places_ = standing_places(scene_.cameras, scene_.model.body.subject.height, config_.sighting);
  const uint32_t newest = frame_ + static_cast<uint32_t>(window_.size());
  const auto score = [&](const Eigen::Vector2d& place) {
    if (!within_reach(place, newest)) return 0.0;
    // Half of the figures, half a step, will do for a first look.
    const std::span<const Pose> figures = figures_.at(kUsualSpeed);
    return place_score(scene_, evidence, figures.first(figures.size() / 2), place,
                       side_on_heading(scene_.cameras[0], place));
  };
  candidates_.push_back(find_figures(score, places_, config_.sighting, threads_));
  window_.push_back(evidence);
  if (static_cast<int>(window_.size()) < frames_in(config_.sighting.window, scene_.dt)) return;
  const auto window_score = [&](size_t frame, const Eigen::Vector2d& place,
                                const Eigen::Vector2d& velocity) {
    return place_score(scene_, window_[frame], figures_.at(velocity.norm()), place,
                       std::atan2(velocity.y(), velocity.x()));
  };
  const auto sighting =
      find_walk(std::vector(candidates_.begin(), candidates_.end()), window_score, scene_.dt,
                camera_centre(scene_.cameras[0]).head<2>(), config_.sighting, threads_);
  if (sighting && within_reach(sighting->position, frame_) && attempt(*sighting, out)) return;
  window_.pop_front();
  candidates_.pop_front();
  ++frame_;
  out.emplace_back();
}

// Tracks the window's frames from a sighting; false, and nothing has happened, if the track
// explains them worse than the straight walk of mere figures that it came from.
bool Tracker::attempt(const Sighting& sighting, std::vector<FrameRecord>& out) {
  const uint32_t first_frame = frame_;
  const auto seen_before = last_seen_;
  const int losses_before = losses_;
  std::vector<FrameRecord> tried;
  begin(sighting, std::nullopt);
  double support = 0;
  for (const SceneEvidence& each : window_) {
    if (mode_ == Mode::kSearching) break;
    consume(each, tried);
  }
  for (const FrameRecord& record : tried) support += record.support;
  if (mode_ == Mode::kTracking && support >= sighting.score * double(tried.size())) {
    window_.clear();
    candidates_.clear();
    std::move(tried.begin(), tried.end(), std::back_inserter(out));
    return true;
  }
  mode_ = Mode::kSearching;
  frame_ = first_frame;
  last_seen_ = seen_before;
  losses_ = losses_before;
  supports_.clear();
  hypotheses_.clear();
  return false;
}

void Tracker::begin(const Sighting& sighting, std::optional<double> stride_phase) {
  const MotionContext motion{scene_.model, prior_, config_.motion, frame_scale_, scene_.dt};
  FilterConfig filter = config_.filter;
  filter.particles = config_.start.particles;
  hypotheses_.clear();
  const auto ranges =
      stride_phase ? phase_ranges(config_.start, *stride_phase) : phase_ranges(config_.start);
  for (const PhaseRange& range : ranges) {
    const uint64_t seed = seed_ + 0x9E3779B97F4A7C15u * ++starts_;  // streams of its own
    hypotheses_.push_back({Filter(filter, seed, threads_), seed, 0, {}});
    hypotheses_.back().filter.start(spawn(motion, config_.start, sighting, range, seed));
  }
  mode_ = Mode::kStarting;
}

void Tracker::compete(const SceneEvidence& evidence, std::vector<FrameRecord>& out) {
  for (Hypothesis& each : hypotheses_) {
    each.records.push_back(advance(each.filter, evidence, each.seed, each.records.empty()));
    each.log_evidence += each.records.back().filter.log_evidence;
  }
  ++frame_;
  double best = -std::numeric_limits<double>::infinity();
  for (const Hypothesis& each : hypotheses_) best = std::max(best, each.log_evidence);
  const size_t frames = hypotheses_.front().records.size();
  if (best == -std::numeric_limits<double>::infinity()) {
    out.resize(out.size() + frames);  // nobody walks like this: frames stay untracked
    mode_ = Mode::kSearching;
    return;
  }
  std::erase_if(hypotheses_,
                [&](const Hypothesis& h) { return h.log_evidence < best - kHopeless; });
  if (static_cast<int>(frames) >= frames_in(config_.start.seconds, scene_.dt)) settle(out);
}

// The hypotheses that are left become one set of particles, each with its share of the evidence.
void Tracker::settle(std::vector<FrameRecord>& out) {
  std::vector<double> evidence;
  for (const Hypothesis& each : hypotheses_) evidence.push_back(each.log_evidence);
  const std::vector<double> share = normalised_weights(evidence);
  const size_t best =
      static_cast<size_t>(std::max_element(share.begin(), share.end()) - share.begin());
  std::vector<WalkerParticle> states;
  std::vector<double> log_weights;
  for (size_t h = 0; h < hypotheses_.size(); ++h) {
    const auto& set = hypotheses_[h].filter.particles();
    const double total = log_sum_exp(set.log_weights);
    for (size_t i = 0; i < set.states.size(); ++i) {
      states.push_back(set.states[i]);
      log_weights.push_back(set.log_weights[i] - total + std::log(share[h]));
    }
  }
  std::vector<uint32_t> parents(static_cast<size_t>(config_.filter.particles));
  systematic_resample(log_weights, Rng(seed_, Purpose::kInitialisation, frame_).uniform(), parents);
  std::vector<WalkerParticle> chosen;
  chosen.reserve(parents.size());
  for (const uint32_t parent : parents) chosen.push_back(states[parent]);
  filter_.start(std::move(chosen));
  supports_.clear();
  for (FrameRecord& record : hypotheses_[best].records) {
    supports_.push_back(record.support);
    out.push_back(std::move(record));
  }
  hypotheses_.clear();
  mode_ = Mode::kTracking;
  frames_below_ = 0;
}

void Tracker::track(const SceneEvidence& evidence, std::vector<FrameRecord>& out) {
  FrameRecord record = advance(filter_, evidence, seed_, false);
  ++frame_;
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

// One frame of the filter: propagate, weigh, resample; then what the particles say.
FrameRecord Tracker::advance(Filter& filter, const SceneEvidence& evidence, uint64_t seed,
                             bool first) {
  const NoiseScale scale = first ? start_scale(config_.start, frame_scale_) : frame_scale_;
  const MotionContext motion{scene_.model, prior_, config_.motion, scale, scene_.dt};
  std::vector<Outcome> outcomes(filter.particles().states.size());
  const auto step = [&](WalkerParticle& particle, uint32_t i) {
    Rng rng(seed, Purpose::kTorque, frame_, i);
    outcomes[i] = first ? arrive(motion, particle, rng) : propagate(motion, particle, rng);
    return outcomes[i] != Outcome::kDead;
  };
  const auto weigh = [&](const WalkerParticle& particle) {
    return log_likelihood(scene_, evidence, particle, !first) +
           log_uprightness(scene_.model, particle.pose);
  };
  filter.predict(step);
  const CourseSpread course =
      course_spread(filter.particles().states, filter.particles().log_weights);
  const auto move = [&](WalkerParticle& particle, double boldness, Rng& rng) {
    if (rng.uniform() < kCourseMoves) return change_course(motion, course, boldness, particle, rng);
    perturb(motion, boldness, particle, rng);
  };
  FrameRecord record;
  record.filter = filter.update(frame_, weigh, move);
  record.fallen = static_cast<int>(std::count(outcomes.begin(), outcomes.end(), Outcome::kFallen));
  record.diverged =
      static_cast<int>(std::count(outcomes.begin(), outcomes.end(), Outcome::kDiverged));
  if (record.filter.all_dead) return record;
  const auto& set = filter.particles();
  const std::vector<double> weights = normalised_weights(set.log_weights);
  for (size_t i = 0; i < weights.size(); ++i)
    if (weights[i] > 0) record.support += weights[i] * set.log_likelihoods[i];
  record.tracked = true;
  record.estimate = estimate_frame(scene_.model, set.states, weights, scene_.dt, threads_);
  std::vector<uint32_t> chosen(static_cast<size_t>(config_.samples));
  systematic_resample(set.log_weights, 0.5, chosen);
  for (const uint32_t i : chosen)
    record.samples.push_back(forward_kinematics(scene_.model.body, set.states[i].pose).joints);
  return record;
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

// Whether the likelihood has stayed for too long far below its own recent median, or below that of
// a mere figure: then the legs are not where they are believed to be.
bool Tracker::fading(double support, double figure) {
  std::vector<double> past(supports_.begin(), supports_.end());
  std::nth_element(past.begin(), past.begin() + static_cast<long>(past.size() / 2), past.end());
  const double median = past[past.size() / 2];
  const bool bad = support < std::max({config_.lost_below * median, kFigureShare * figure,
                                       config_.sighting.least_score});
  frames_below_ = bad ? frames_below_ + 1 : 0;
  // Bad frames do not become the measure of good ones.
  if (frames_below_ == 0) supports_.push_back(support);
  if (static_cast<int>(supports_.size()) > frames_in(config_.recall, scene_.dt))
    supports_.pop_front();
  return frames_below_ >= frames_in(config_.lost_after, scene_.dt);
}

}  // namespace walktrack
