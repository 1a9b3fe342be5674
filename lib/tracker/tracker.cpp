#include "tracker/tracker.h"

#include <utility>

#include "tracker/start/keypoint_lead.h"
#include "tracker/start/trial.h"

namespace walktrack {
inline namespace tracker {

Tracker::Tracker(TrackerScene scene, const GaitPrior& prior, const TrackerConfig& config,
                 uint64_t seed, int threads)
    : scene_(std::move(scene)),
      prior_(prior),
      config_(config),
      seed_(seed),
      threads_(threads),
      subject_(scene_.model, prior, config.motion, scene_.dt),
      mode_(Searching{WalkerFilter(config.filter, seed, threads), {}}) {
  config_.detector = detector_for(scene_, config.detector);
  const KeypointConfig& keypoints = scene_.observation.keypoints;
  if (is_on(keypoints) && keypoints.lead == TermSetting::kOn) lead_by_keypoints();
}

std::vector<FrameRecord> Tracker::push(const SceneEvidence& evidence) {
  Records out;
  consume(evidence, out);
  return out;
}

std::vector<FrameRecord> Tracker::finish() {
  Records out;
  if (scene_.initial && search_.window().size() > 1) start_as_given(out);
  // The window is what is left of the video, and a frame less each time.
  while (is_searching(mode_) && !scene_.initial && search_.lasts(kShortestWindow, scene_.dt)) {
    config_.detector.window = scene_.dt * static_cast<double>(search_.window().size());
    look_for_walk(out);
  }
  if (std::holds_alternative<Starting>(mode_)) report(settle(mode_), {}, out);
  out.resize(out.size() + search_.waiting() + search_.window().size());
  search_.take();
  return out;
}

void Tracker::consume(const SceneEvidence& evidence, Records& out) {
  if (is_searching(mode_)) return search(evidence, out);
  const bool tracked = tracking();
  if (!tracked) starting_.push_back(evidence);
  report(follow(context(), evidence, frame_++, mode_), evidence, out);
  if (tracked && !tracking()) ++losses_;
}

// Frames of a start are reported when it has been decided who walks there, and which leg is which.
void Tracker::report(Records records, const SceneEvidence& newest, Records& out) {
  for (FrameRecord& record : records) {
    judge(context(), starting_.empty() ? newest : starting_.front(), record);
    if (!starting_.empty()) starting_.pop_front();
    out.push_back(std::move(record));
  }
}

void Tracker::search(const SceneEvidence& evidence, Records& out) {
  if (scene_.initial && frame_ < static_cast<uint32_t>(scene_.initial_frame)) {
    ++frame_;
    out.emplace_back();
    return;
  }
  search_.push(evidence);
  const bool needs_window = !scene_.initial || wants_size();
  if (needs_window && !search_.lasts(config_.detector.window, scene_.dt)) return;
  scene_.initial ? start_as_given(out) : look_for_walk(out);
}

void Tracker::look_for_walk(Records& out) {
  if (start_from_window(out)) return;
  if (std::exchange(outlines_misled_, false)) {
    lead_by_keypoints();
    if (start_from_window(out)) return;
  }
  ++frame_;
  if (search_.slide(context())) out.emplace_back();
}

bool Tracker::start_from_window(Records& out) {
  const std::optional<DetectedWalk> walk = search_.find(context(), moment());
  return walk && (wants_size() ? start_unsized(*walk, out) : start_sized(*walk, out));
}

void Tracker::lead_by_keypoints() {
  let_keypoints_lead(scene_.observation);
  search_.forget_scores();
}

Starting Tracker::started(const DetectedWalk& walk, std::optional<double> stride_phase) {
  return start_around(context(), walk, stride_phase, ++starts_, std::get<Searching>(mode_));
}

// Tracks the window's frames from a walk on, and `lead` frames before them; if that fails it
// returns false, and nothing has changed.
bool Tracker::start_at(const DetectedWalk& walk, size_t lead, Records& out) {
  if (outlines_misled_) return false;
  search_.reach_back(lead);
  const size_t frames = search_.window().size();
  Trial trial = try_start(context(), search_.window(), frame_ - static_cast<uint32_t>(lead),
                          started(walk, std::nullopt), walk.score * static_cast<double>(frames));
  if (!is_searching(trial.mode) && !keypoints_lead() && may_lead(scene_, walk))
    outlines_misled_ = outlines_fit_badly(scene_, search_.window(), trial.records);
  if (!outlines_misled_) mode_ = std::move(trial.mode);
  if (is_searching(mode_)) {
    search_.let_go(lead);
    return false;
  }
  out.resize(out.size() + search_.waiting());  // in these frames nobody was tracked
  frame_ += static_cast<uint32_t>(frames - lead);
  starting_ = search_.take();
  report(std::move(trial.records), {}, out);
  return true;
}

// Starts where the subject stands before the walk, if they do; otherwise with the walk.
bool Tracker::start_sized(const DetectedWalk& walk, Records& out) {
  const std::optional<StandingStart> lead = search_.standing_lead(context(), walk);
  return (lead && start_at(lead->detected, lead->frames, out)) || start_at(walk, 0, out);
}

bool Tracker::start_unsized(const DetectedWalk& walk, Records& out) {
  const double height_before = body().subject.height;
  const SizedWalk sized = search_.with_size(context(), moment(), walk);
  set_height(sized.stature.height, sized.stature);
  if (start_at(sized.walk, 0, out)) return true;
  set_height(height_before, std::nullopt);
  return false;
}

// Starts in the window's first frame at the place that the scene states.
void Tracker::start_as_given(Records& out) {
  const DetectedWalk given = *std::exchange(scene_.initial, std::nullopt);
  if (wants_size()) {
    const Stature stature = search_.with_size_along(context(), moment(), given).stature;
    set_height(stature.height, stature);
  }
  mode_ = started(given, scene_.initial_phase);
  for (const SceneEvidence& each : search_.take()) consume(each, out);
}

void Tracker::set_height(double height, const std::optional<Stature>& estimate) {
  stature_ = estimate;
  scene_.model = with_height(scene_.model, height);
  subject_ = SubjectModel(scene_.model, prior_, config_.motion, scene_.dt);
  search_.forget_places();
}

TrackerState Tracker::state() const {
  const Tracking& now = tracked();
  return {frame_,   starts_,         now.filter.state(), now.monitor, losses_, now.p_legs_swapped,
          stature_, keypoints_lead()};
}

void Tracker::resume(TrackerState state) {
  WalkerFilter filter(config_.filter, seed_, threads_);
  filter.resume(std::move(state.filter));
  mode_ = Tracking{std::move(filter), std::move(state.monitor), state.p_legs_swapped, {}};
  scene_.initial.reset();  // it has been used
  frame_ = state.frame;
  starts_ = state.starts;
  losses_ = state.losses;
  if (state.stature) set_height(state.stature->height, state.stature);
  if (state.keypoints_lead) lead_by_keypoints();
}

}  // namespace tracker
}  // namespace walktrack
