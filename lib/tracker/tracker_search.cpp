// The tracker while it looks for a walk: with figures, along lines, and of which size.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/anthropometry.h"
#include "core/conventions.h"
#include "core/parallel_for.h"
#include "tracker/detect/keypoint_lines.h"
#include "tracker/leg_label_evidence.h"
#include "tracker/moves/mirror_legs.h"
#include "tracker/tracker.h"

namespace walktrack {

namespace {

using anthropometry::kUsualSpeed;
// Frames before a walk are kept for so long, s, to follow somebody who stood there first.
constexpr double kStandingKept = 3;
// Log-odds at which the pictures agree with the names of the legs, and at which they swap them:
// set on 80 made walks, four of which were swapped rightly and one wrongly
// (reports/left_and_right.md).
constexpr double kAgreed = 1.5, kSwapped = 0.75;

// A probability after evidence against it, nats.
double updated(double probability, double against) {
  return probability / (probability + std::exp(against) * (1 - probability));
}

double total_log_likelihood(const std::vector<FrameRecord>& records) {
  double sum = 0;
  for (const FrameRecord& record : records) sum += record.mean_log_likelihood;
  return sum;
}

}  // namespace

void Tracker::search(const SceneEvidence& evidence, std::vector<FrameRecord>& out) {
  if (scene_.initial) {
    if (frame_ < static_cast<uint32_t>(scene_.initial_frame)) {
      ++frame_;
      out.emplace_back();
      return;
    }
    if (!wants_size()) {
      begin(*std::exchange(scene_.initial, std::nullopt), scene_.initial_phase);
      return compete(evidence, out);
    }
  }
  candidates_.emplace_back();
  window_.push_back(evidence);
  if (static_cast<int>(window_.size()) < frames_in(config_.detector.window, scene_.dt)) return;
  if (scene_.initial) return start_as_given(out);
  const WindowEnds ends = window_ends(window_.size());
  const std::vector<DetectedWalk> lines = lines_by_keypoints();
  const std::optional<DetectedWalk> detected = detect_walk(
      {window_.size(), candidates(ends.early), candidates(ends.late), lines},
      window_score(body(), kit_.figures), scene_.dt, camera_position(), config_.detector, threads_);
  if (detected && within_reach(detected->position, frame_) && attempt_found(*detected, out)) return;
  slide(out);
}

// The window begins a frame later.
void Tracker::slide(std::vector<FrameRecord>& out) {
  waiting_.push_back(std::move(window_.front()));
  window_.pop_front();
  candidates_.pop_front();
  ++frame_;
  const auto kept =
      kit_.standing ? static_cast<size_t>(frames_in(kStandingKept, scene_.dt)) : size_t{0};
  if (waiting_.size() <= kept) return;
  waiting_.pop_front();
  out.emplace_back();
}

bool Tracker::attempt_found(const DetectedWalk& walk, std::vector<FrameRecord>& out) {
  if (!walks_clearly(walk)) return false;
  std::vector<FrameRecord> found;
  const bool sized = wants_size();
  if (!(sized ? attempt_unsized(walk, found)
              : attempt_standing(walk, found) || attempt(walk, found)))
    return false;
  out.resize(out.size() + waiting_.size());  // of those before nobody was followed
  waiting_.clear();
  std::move(found.begin(), found.end(), std::back_inserter(out));
  return true;
}

// Somebody who stands is now and then seen to walk slowly, above all along the viewing ray: such a
// walk is believed when it has been seen for as long as the window.
bool Tracker::walks_clearly(const DetectedWalk& walk) {
  constexpr double kClearly = 0.15, kSlightly = 0.05;
  if (!kit_.standing || walk.over_standing >= kClearly) return true;
  slight_walks_ = walk.over_standing >= kSlightly ? slight_walks_ + 1 : 0;
  return slight_walks_ >= window_.size();
}

std::optional<StandingStart> Tracker::standing_lead(const DetectedWalk& walk) const {
  const Pose figure = standing_pose(scene_.model);
  const auto score = [&](size_t back, const Eigen::Vector2d& place,
                         double heading) -> std::optional<double> {
    if (back > waiting_.size()) return std::nullopt;
    return place_score(scene_, waiting_[waiting_.size() - back], body(), {&figure, 1}, place,
                       heading);
  };
  return standing_before(walk, score, scene_.dt, config_.detector);
}

// Tracks from where somebody stands before the walk, if anybody does.
bool Tracker::attempt_standing(const DetectedWalk& walk, std::vector<FrameRecord>& out) {
  if (waiting_.empty()) return false;
  std::optional<StandingStart> lead = standing_lead(walk);
  if (!lead) return false;
  const double walked = walk.score * double(window_.size());
  for (size_t i = 0; i < lead->frames; ++i) {
    window_.push_front(std::move(waiting_.back()));
    waiting_.pop_back();
    candidates_.emplace_front();
  }
  frame_ -= static_cast<uint32_t>(lead->frames);
  lead->detected.score = (walked + lead->score) / double(window_.size());
  if (attempt(lead->detected, out)) return true;
  for (size_t i = 0; i < lead->frames; ++i) {
    waiting_.push_back(std::move(window_.front()));
    window_.pop_front();
    candidates_.pop_front();
  }
  frame_ += static_cast<uint32_t>(lead->frames);
  return false;
}

// The lines along which keypoints go at a walker's speed.
std::vector<DetectedWalk> Tracker::lines_by_keypoints() const {
  constexpr double kLeastShare = 0.5;  // of the window in which the person was seen
  std::vector<DetectedWalk> out;
  for (size_t c = 0; c < scene_.cameras.size(); ++c) {
    std::vector<const KeypointEvidence*> frames;
    for (const SceneEvidence& frame : window_) frames.push_back(&frame[c].keypoints);
    for (const KeypointLine& line :
         keypoint_lines(frames, scene_.cameras[c], body().subject.height, scene_.dt,
                        kLeastShare * config_.detector.window)) {
      const double speed = line.velocity.norm();
      if (speed >= config_.detector.slowest && speed <= config_.detector.fastest)
        out.push_back({.position = line.position, .velocity = line.velocity});
    }
  }
  return out;
}

WindowScore Tracker::window_score(const Body& body, const PoseTemplates& figures) const {
  return [&](size_t frame, const Eigen::Vector2d& place, const Eigen::Vector2d& velocity) {
    const double heading = std::atan2(velocity.y(), velocity.x());
    return place_score(scene_, window_[frame], body, figures.at(velocity.norm(), heading), place,
                       heading);
  };
}

// The walk that figures of another body see in the window.
std::optional<DetectedWalk> Tracker::look_for_walk(const BodyModel& model) const {
  const PoseTemplates figures(model, prior_);
  const WindowEnds ends = window_ends(window_.size());
  const std::vector<Place> early = places_in_frame(ends.early, model.body, figures),
                           late = places_in_frame(ends.late, model.body, figures);
  return detect_walk({window_.size(), early, late}, window_score(model.body, figures), scene_.dt,
                     camera_position(), config_.detector, threads_);
}

// Where the camera stands that is asked for distances.
Eigen::Vector2d Tracker::camera_position() const {
  return camera_centre(scene_.cameras[0]).head<2>();
}

SizedWalk Tracker::sized_up(const DetectedWalk& walk, double height) const {
  const auto score = [this](double tried) -> WindowScore {
    const BodyModel model = with_height(scene_.model, tried);
    return [this, body = model.body, figures = PoseTemplates(model, prior_)](
               size_t frame, const Eigen::Vector2d& place, const Eigen::Vector2d& velocity) {
      return window_score(body, figures)(frame, place, velocity);
    };
  };
  return size_up(walk, height, window_.size(), score, scene_.dt, camera_position());
}

// The size and line that explain the window best. Figures of a wrong size may lay the line far off,
// so it is looked for with others, too.
SizedWalk Tracker::best_size(const DetectedWalk& found) const {
  std::vector<SizedWalk> sizes{{{body().subject.height, 0}, found}};
  for (const double height : {1.3, 1.5, 1.6, 1.9}) {
    const auto other = look_for_walk(with_height(scene_.model, height));
    if (other) sizes.push_back({{height, 0}, *other});
  }
  parallel_for(sizes.size(), threads_,
               [&](size_t i) { sizes[i] = sized_up(sizes[i].walk, sizes[i].stature.height); });
  return *std::max_element(sizes.begin(), sizes.end(), [](const SizedWalk& a, const SizedWalk& b) {
    return a.walk.score < b.walk.score;
  });
}

bool Tracker::attempt_unsized(const DetectedWalk& found, std::vector<FrameRecord>& out) {
  const double height_before = body().subject.height;
  const SizedWalk sized = best_size(found);
  take_size(sized.stature);
  if (attempt(sized.walk, out)) return true;
  stature_.reset();
  set_height(height_before);
  return false;
}

void Tracker::take_size(const Stature& stature) {
  stature_ = stature;
  set_height(stature.height);
}

void Tracker::set_height(double height) {
  scene_.model = with_height(scene_.model, height);
  kit_ = SubjectModel(scene_.model, prior_, config_.motion, scene_.dt);
  places_.clear();
}

// Starts where the scene says, the window's first frame, and tracks the window's frames.
void Tracker::start_as_given(std::vector<FrameRecord>& out) {
  const DetectedWalk given = *std::exchange(scene_.initial, std::nullopt);
  take_size(sized_up(given, body().subject.height).stature);
  const std::deque<SceneEvidence> frames = std::exchange(window_, {});
  candidates_.clear();
  begin(given, scene_.initial_phase);
  for (const SceneEvidence& each : frames) consume(each, out);
}

// Where somebody may stand in a frame of the window.
std::vector<Place> Tracker::places_in_frame(size_t index, const Body& body,
                                            const PoseTemplates& book) const {
  const auto score = [&](const Eigen::Vector2d& place) {
    if (!within_reach(place, frame_ + static_cast<uint32_t>(index))) return 0.0;
    // Half of the figures, half a step, will do for a first look.
    const double heading = side_on_heading(scene_.cameras[0], place);
    const std::span<const Pose> figures = book.at(kUsualSpeed, heading);
    return place_score(scene_, window_[index], body, figures.first(figures.size() / 2), place,
                       heading);
  };
  return find_figures(score, places_, config_.detector, threads_);
}

const std::vector<Place>& Tracker::candidates(size_t index) {
  if (places_.empty())
    places_ = standing_places(scene_.cameras, body().subject.height, config_.detector);
  std::optional<std::vector<Place>>& found = candidates_[index];
  if (!found) found = places_in_frame(index, body(), kit_.figures);
  return *found;
}

// What came of tracking the window's frames.
struct Tracker::Trial {
  std::vector<FrameRecord> records;           // finished ones
  std::optional<TrackerState> settled, last;  // when the start was decided, and at the end
  size_t settled_after = 0;                   // frames
  double legs = 0;                            // log-odds that the legs bear the right names
};

// Goes on behind the trial's records.
void Tracker::follow_rest(Trial& trial) {
  for (size_t i = trial.records.size(); i < window_.size() && mode_ != Mode::kSearching; ++i) {
    consume(window_[i], trial.records);
    if (!tracking() || trial.settled) continue;
    trial.settled = state();
    trial.settled_after = trial.records.size();
  }
  if (!tracking()) return;
  trial.last = state();
  if (scene_.cameras.size() == 1) trial.legs = legs_log_odds(scene_, window_, trial.records);
}

// The trial again as far as its start was decided, and then with the legs swapped.
Tracker::Trial Tracker::with_mirrored_legs(const Trial& trial) {
  Trial other;
  other.settled = trial.settled;
  const auto start = trial.records.begin();
  other.records.assign(start, start + static_cast<long>(trial.settled_after));
  for (FrameRecord& record : other.records) mirror_legs(body(), record);
  for (WalkerParticle& each : other.settled->filter.set.states)
    mirror_legs(context(false).motion, each);
  resume(*other.settled);
  follow_rest(other);
  return other;
}

// A start names the legs by outlines, which from the side look the same with the legs swapped.
// Where the pictures do not quite agree, both names are tried.
Tracker::Trial Tracker::with_legs_named(Trial first) {
  double doubt = first.last->p_legs_swapped, odds = first.legs;
  if (odds < kAgreed) {
    Trial other = with_mirrored_legs(first);
    odds = 0.5 * (first.legs - other.legs);
    if (other.last && odds < -kSwapped) {
      first = std::move(other);
      doubt = 0.5;  // the outlines' word is not worth much here
      odds = -odds;
    }
  }
  first.last->p_legs_swapped = updated(doubt, odds);
  resume(*first.last);
  for (FrameRecord& record : first.records)
    record.modes.p_legs_swapped = first.last->p_legs_swapped;
  return first;
}

// Tracks the window's frames from a detected; false, and nothing has happened, if the track
// explains them worse than the straight walk of mere figures that it came from.
bool Tracker::attempt(const DetectedWalk& detected, std::vector<FrameRecord>& out) {
  const uint32_t first_frame = frame_;
  const auto seen_before = monitor_.last_seen;
  const int losses_before = losses_;
  begin(detected, std::nullopt);
  Trial trial;
  follow_rest(trial);
  if (trial.legs != 0) trial = with_legs_named(std::move(trial));
  const double log_likelihood = total_log_likelihood(trial.records) +
                                (hypotheses_ ? total_log_likelihood(hypotheses_->records()) : 0);
  if (mode_ != Mode::kSearching && log_likelihood >= detected.score * double(window_.size())) {
    std::deque<SceneEvidence> frames = std::exchange(window_, {});
    candidates_.clear();
    for (size_t i = 0; i < trial.records.size(); ++i) refine(frames[i], trial.records[i]);
    // Start hypotheses that go on have all of the window's frames before it.
    if (hypotheses_) hypotheses_frames_ = std::move(frames);
    std::move(trial.records.begin(), trial.records.end(), std::back_inserter(out));
    return true;
  }
  mode_ = Mode::kSearching;
  frame_ = first_frame;
  monitor_.last_seen = seen_before;
  losses_ = losses_before;
  hypotheses_.reset();
  hypotheses_frames_.clear();
  return false;
}

// What a figure out of the gait's book would score where the walker is believed to be, whichever
// way it faces.
double Tracker::figure_score(const SceneEvidence& evidence, const FrameEstimate& estimate) const {
  constexpr int kHeadings = 6;
  double best = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < kHeadings; ++k) {
    const double heading = estimate.pose.heading + 2 * kPi * k / kHeadings;
    best =
        std::max(best, place_score(scene_, evidence, body(), kit_.figures.at(kUsualSpeed, heading),
                                   estimate.pose.root.head<2>(), heading));
  }
  return best;
}

}  // namespace walktrack
