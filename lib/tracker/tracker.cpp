#include "tracker/tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracker/start/keypoint_lead.h"
#include "tracker/start/new_start.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Time between two windows in which a walk is searched, s. By hand.
constexpr double kBetweenWindows = 0.1;

size_t frames_between_windows(double dt) {
  return static_cast<size_t>(std::max(1L, std::lround(kBetweenWindows / dt)));
}

// Where the subject is in the newest frame; nullopt if nobody is followed.
std::optional<Eigen::Vector2d> newest_place(const TrackMode& mode) {
  if (const Tracking* now = std::get_if<Tracking>(&mode)) return now->mean_pose.root.head<2>();
  const Starting* start = std::get_if<Starting>(&mode);
  if (!start || start->hypotheses.frames() == 0) return std::nullopt;
  return start->hypotheses.records().back().estimate.pose.root.head<2>();
}

}  // namespace

Tracker::Tracker(TrackerScene scene, const GaitPrior& prior, const TrackerConfig& config,
                 uint64_t seed, int threads)
    : subject_(std::move(scene), prior, config, seed, threads),
      mode_(Searching{WalkerFilter(config.filter, seed, threads), {}}) {}

std::vector<FrameRecord> Tracker::push(const SceneEvidence& evidence) {
  Records out;
  consume(evidence, out);
  return out;
}

std::vector<FrameRecord> Tracker::finish() {
  Records out;
  if (given() && search_.window().size() > 1) start_given(out);
  // The window is what is left of the video, and a frame less each time.
  while (is_searching(mode_) && !given() && search_.lasts(kShortestWindow, subject_.scene.dt)) {
    subject_.config.detector.window =
        subject_.scene.dt * static_cast<double>(search_.window().size());
    look_for_walk(1, out);
  }
  if (std::holds_alternative<Starting>(mode_)) report(settle(mode_), {}, out);
  if (holding(mode_))
    report(decide_held(subject_.context(), waiting_, false, starts_, mode_), {}, out);
  if (Tracking* now = std::get_if<Tracking>(&mode_))
    report(decide_turning(subject_.context(), frame_ - 1, *now), {}, out);
  out.resize(out.size() + search_.waiting() + search_.window().size());
  search_.take();
  return out;
}

void Tracker::consume(const SceneEvidence& evidence, Records& out) {
  if (is_searching(mode_)) return search(evidence, out);
  const bool tracked = tracking();
  const std::optional<SceneEvidence> rest = without_others(evidence);
  const SceneEvidence& subjects = rest ? *rest : evidence;
  Records records = follow(subject_.context(), subjects, frame_++, mode_);
  if (const auto newest = newest_place(mode_)) expect_subject(subject_.context(), *newest, people_);
  if (records.size() <= waiting_.size()) waiting_.push_back(subjects);  // this frame waits as well
  if (held_enough(mode_)) records = decide_held(subject_.context(), waiting_, true, starts_, mode_);
  report(std::move(records), subjects, out);
  if (tracked && !tracking()) ++losses_;
}

std::optional<SceneEvidence> Tracker::without_others(const SceneEvidence& evidence) {
  if (!subject_.follows_others()) return std::nullopt;
  follow_others(subject_.context(), evidence, people_);
  auto rest = walktrack::without_others(subject_.context(), people_, evidence);
  if (rest) ++frames_beside_others_;
  return rest;
}

// Frames of a start are reported when it has been decided who walks there, and which leg is which,
// and those of a subject who may turn when that has been decided.
void Tracker::report(Records records, const SceneEvidence& newest, Records& out) {
  for (FrameRecord& record : records) {
    judge(subject_.context(), waiting_.empty() ? newest : waiting_.front(), record);
    if (!waiting_.empty()) waiting_.pop_front();
    out.push_back(std::move(record));
  }
}

void Tracker::search(const SceneEvidence& evidence, Records& out) {
  const TrackerScene& scene = subject_.scene;
  if (before_given()) {
    ++frame_;
    out.emplace_back();
    return;
  }
  search_.push(evidence);
  if (!search_.lasts(subject_.config.detector.window, scene.dt)) return;
  if (given() && start_given(out)) return;
  look_for_walk(frames_between_windows(scene.dt), out);
}

// If the newest window has a walk, the windows before it that were not looked at come first.
void Tracker::look_for_walk(size_t step, Records& out) {
  const SearchMoment moment{frame_, std::get<Searching>(mode_).last_seen};
  if (const auto back = search_.look(subject_.context(), moment, step)) {
    search_.step_back(*back);
    for (size_t before = *back;; --before) {
      const auto first = frame_ - static_cast<uint32_t>(before);
      if (auto start = start_in_window(subject_, search_, first, starts_, mode_))
        return begin(std::move(*start), out);
      if (before == 0) break;
      search_.step_on();
    }
  }
  ++frame_;
  if (search_.slide(subject_.context())) out.emplace_back();
}

void Tracker::begin(WindowStart start, Records& out) {
  out.resize(out.size() + start.untracked);
  frame_ = start.first_frame + static_cast<uint32_t>(start.frames.size());
  waiting_ = std::move(start.frames);
  Tracking* now = std::get_if<Tracking>(&mode_);
  people_ = std::move(start.people);
  if (now && holds_frames(subject_.context())) {
    now->held = held_start(subject_.context(), start.first_frame, std::move(start.records),
                           start.legs_in_doubt);
  } else {
    report(std::move(start.records), {}, out);
  }
  for (const SceneEvidence& each : search_.take_later()) consume(each, out);
}

bool Tracker::start_given(Records& out) {
  auto start = start_in_window(subject_, search_, frame_, starts_, mode_);
  subject_.scene.initial.reset();
  if (start) begin(*std::move(start), out);
  return !is_searching(mode_);
}

TrackerState Tracker::state() const {
  const Tracking& now = tracked();
  return {frame_,
          starts_,
          now.filter.state(),
          now.monitor,
          losses_,
          now.p_legs_swapped,
          now.speed,
          estimates(),
          keypoints_lead(),
          people_,
          frames_beside_others_};
}

void Tracker::resume(TrackerState state) {
  WalkerFilter filter(subject_.config.filter, subject_.seed, subject_.threads);
  filter.resume(std::move(state.filter));
  mode_ =
      Tracking{std::move(filter), std::move(state.monitor), state.p_legs_swapped, {}, state.speed};
  subject_.scene.initial.reset();  // it has been used
  frame_ = state.frame;
  starts_ = state.starts;
  losses_ = state.losses;
  people_ = std::move(state.people);
  frames_beside_others_ = state.frames_beside_others;
  const SubjectEstimates& known = state.estimates;
  if (known.stature) subject_.set_height(known.stature->height, known.stature);
  subject_.shape_decided = true;
  if (known.girth) subject_.set_girth(*known.girth);
  if (known.trunk) subject_.set_trunk(known.trunk);
  if (state.keypoints_lead) subject_.let_keypoints_lead();
}

}  // namespace tracker
}  // namespace walktrack
