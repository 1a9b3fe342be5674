#include "tracker/tracker.h"

#include <utility>

#include "tracker/start/trial.h"

namespace walktrack {
inline namespace tracker {

namespace {

// What is left of a video is searched from so many seconds on: as long as start hypotheses compete.
constexpr double kShortestWindow = 0.5;

}  // namespace

Tracker::Tracker(TrackerScene scene, const GaitPrior& prior, const TrackerConfig& config,
                 uint64_t seed, int threads)
    : scene_(std::move(scene)),
      prior_(prior),
      config_(config),
      seed_(seed),
      threads_(threads),
      subject_(scene_.model, prior, config.motion, scene_.dt),
      mode_(Searching{WalkerFilter(config.filter, seed, threads), {}}) {}

std::vector<FrameRecord> Tracker::push(const SceneEvidence& evidence) {
  Records out;
  consume(evidence, out);
  return out;
}

std::vector<FrameRecord> Tracker::finish() {
  Records out;
  const auto left = [this] { return static_cast<int>(search_.window().size()); };
  if (scene_.initial && left() > 1) start_as_given(out);
  // The window is what is left, and less and less of it.
  while (is_searching(mode_) && !scene_.initial &&
         left() >= frames_in(kShortestWindow, scene_.dt)) {
    config_.detector.window = scene_.dt * left();
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
  Records records = follow(context(), evidence, frame_++, mode_);
  if (tracked && !tracking()) ++losses_;
  report(std::move(records), evidence, out);
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
  if (scene_.initial && !wants_size()) {
    mode_ = started(*std::exchange(scene_.initial, std::nullopt), scene_.initial_phase);
    return consume(evidence, out);
  }
  search_.push(evidence);
  const int wanted = frames_in(config_.detector.window, scene_.dt);
  if (static_cast<int>(search_.window().size()) < wanted) return;
  scene_.initial ? start_as_given(out) : look_for_walk(out);
}

void Tracker::look_for_walk(Records& out) {
  const std::optional<DetectedWalk> walk = search_.find(context(), moment());
  if (walk && (wants_size() ? start_unsized(*walk, out)
                            : start_standing(*walk, out) || start_at(*walk, out)))
    return;
  ++frame_;
  if (search_.slide(context())) out.emplace_back();
}

Starting Tracker::started(const DetectedWalk& walk, std::optional<double> stride_phase) {
  return start_around(context(), walk, stride_phase, ++starts_, std::get<Searching>(mode_));
}

// Tracks the window's frames from a walk on; false, and nothing has happened, if that fails.
bool Tracker::start_at(const DetectedWalk& walk, Records& out) {
  const size_t frames = search_.window().size();
  Trial trial = try_start(context(), search_.window(), frame_, started(walk, std::nullopt),
                          walk.score * static_cast<double>(frames));
  mode_ = std::move(trial.mode);
  if (is_searching(mode_)) return false;
  out.resize(out.size() + search_.waiting());  // of those before nobody was followed
  frame_ += static_cast<uint32_t>(frames);
  starting_ = search_.take();
  report(std::move(trial.records), {}, out);
  return true;
}

// Tracks from where somebody stands before the walk, if anybody does.
bool Tracker::start_standing(const DetectedWalk& walk, Records& out) {
  const std::optional<StandingStart> lead = search_.standing_lead(context(), walk);
  if (!lead) return false;
  const auto frames = static_cast<uint32_t>(lead->frames);
  search_.reach_back(frames);
  frame_ -= frames;
  if (start_at(lead->detected, out)) return true;
  search_.let_go(frames);
  frame_ += frames;
  return false;
}

// Tracks the walk of somebody of unknown height.
bool Tracker::start_unsized(const DetectedWalk& walk, Records& out) {
  const double height_before = body().subject.height;
  const SizedWalk sized = search_.with_size(context(), moment(), walk);
  stature_ = sized.stature;
  set_height(sized.stature.height);
  if (start_at(sized.walk, out)) return true;
  stature_.reset();
  set_height(height_before);
  return false;
}

// Starts where the scene says, the window's first frame, and tracks the window's frames.
void Tracker::start_as_given(Records& out) {
  const DetectedWalk given = *std::exchange(scene_.initial, std::nullopt);
  stature_ = search_.with_size_along(context(), moment(), given).stature;
  set_height(stature_->height);
  mode_ = started(given, scene_.initial_phase);
  for (const SceneEvidence& each : search_.take()) consume(each, out);
}

void Tracker::set_height(double height) {
  scene_.model = with_height(scene_.model, height);
  subject_ = SubjectModel(scene_.model, prior_, config_.motion, scene_.dt);
  search_.forget_places();
}

TrackerState Tracker::state() const {
  const Tracking& now = tracked();
  return {frame_, starts_, now.filter.state(), now.monitor, losses_, now.p_legs_swapped, stature_};
}

void Tracker::resume(TrackerState state) {
  Tracking now{WalkerFilter(config_.filter, seed_, threads_),
               std::move(state.monitor),
               state.p_legs_swapped,
               {}};
  now.filter.resume(std::move(state.filter));
  mode_ = std::move(now);
  scene_.initial.reset();  // used up
  frame_ = state.frame;
  starts_ = state.starts;
  losses_ = state.losses;
  stature_ = state.stature;
  if (stature_) set_height(stature_->height);
}

void Tracker::use_particles(int count) {
  config_.filter.particles = count;
  if (tracking()) walktrack::use_particles(count, std::get<Tracking>(mode_));
}

}  // namespace tracker
}  // namespace walktrack
