#include "tracker/detect/walk_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/parallel_for.h"
#include "tracker/detect/clothes.h"
#include "tracker/detect/detector.h"
#include "tracker/detect/half_hidden.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Time for which frames before a walk are kept, s, to track a subject who stood there first. By
// hand.
constexpr double kStandingKept = 3;
// The longest time for which a subject who is half hidden is waited for, s. By hand.
constexpr double kMostPatience = 0.7;
// Shares of the score by which walking explains a window better than standing: clearly; in a window
// beside one with a clear walk. By hand; sensitivity not measured.
constexpr double kClearWalk = 0.15, kPromisingWalk = 0.1;
// Share of a walk's score by which walking on backwards has to explain a frame before the walk
// better than standing: .07 and more of people who walked, up to .05 of a man who stood
// (reports/standing.md).
constexpr double kClearlyWalked = 0.06;
// Of a window in which a walk has been found already.
constexpr double kAlreadyFound = -std::numeric_limits<double>::infinity();

// Nats, of the figure of a walk whose place is that in the frame.
double score_at(const TrackContext& context, const SceneEvidence& frame, const DetectedWalk& walk) {
  const double heading = std::atan2(walk.velocity.y(), walk.velocity.x());
  return place_score(context.scene, frame, context.body(),
                     context.subject.figures.at(walk.velocity.norm(), heading), walk.position,
                     heading);
}

// Weighs the pixels of a frame as those of a subject at that place.
void weigh_pixels(const TrackContext& context, const Eigen::Vector2d& place, SceneEvidence& frame) {
  for (size_t c = 0; c < frame.size(); ++c) {
    const Region region =
        person_region(context.scene.cameras[c], place, context.body().subject.height, 0);
    if (region.area.empty()) continue;  // behind the camera
    frame[c].pixel_weight = independent_share(context.scene.observation, region.metres_per_px);
  }
}

}  // namespace

void WalkSearch::push(const SceneEvidence& evidence) {
  candidates_.emplace_back();
  window_.push_back(evidence);
}

bool WalkSearch::lasts(double seconds, double dt) const {
  return static_cast<int>(window_.size()) >= frames_in(seconds, dt);
}

void WalkSearch::forget_scores() {
  for (std::optional<std::vector<Place>>& found : candidates_) found.reset();
}

SearchWindow WalkSearch::view(const TrackContext& context, const SearchMoment& moment) const {
  return {context, window_, moment.first_frame, moment.last_seen, places_};
}

std::optional<size_t> WalkSearch::look(const TrackContext& context, const SearchMoment& moment,
                                       size_t step) {
  if (half_hidden_) return 0;
  const size_t back = passed_.value_or(0);
  if (passed_ && back + 1 < step) {
    passed_ = back + 1;
    return std::nullopt;
  }
  const bool moved_on = slight_walks_.moved_on_from.has_value();
  const bool promising = back == 0 || find_here(context, moment, kPromisingWalk);
  passed_ = 0;
  if (!promising) return std::nullopt;
  const auto& from = slight_walks_.moved_on_from;
  if (moved_on || !from) return back;
  return std::min<size_t>(moment.first_frame - *from, waiting_.size());
}

std::optional<FoundWalk> WalkSearch::find(const TrackContext& context, const SearchMoment& moment) {
  const double dt = context.scene.dt;
  const uint32_t now = moment.first_frame;
  const bool last_chance = static_cast<int>(window_.size()) <= frames_in(kShortestWindow, dt);
  if (half_hidden_ && now < half_hidden_->search_at && !last_chance) return std::nullopt;
  const std::optional<DetectedWalk> walk = find_here(context, moment, kClearWalk);
  if (!half_hidden_ && !walk) return std::nullopt;
  if (!half_hidden_ && walk->hidden_frames == 0)
    return FoundWalk{in_its_clothes(context, moment, *walk)};
  if (!half_hidden_ && last_chance) return FoundWalk{*walk};
  if (!half_hidden_) half_hidden_ = HalfHidden{*walk, now, now};
  const uint32_t waited = now - half_hidden_->frame;
  const bool clear = walk && walk->hidden_frames == 0;
  const auto next = static_cast<uint32_t>(walk ? std::max<size_t>(walk->hidden_frames, 1) : 1);
  if (!clear && !last_chance && dt * (waited + next) <= kMostPatience) {
    half_hidden_->search_at = now + next;
    return std::nullopt;
  }
  const DetectedWalk first = moved(half_hidden_->walk, dt * waited);
  half_hidden_.reset();
  return clear ? FoundWalk{*walk, waited, first} : FoundWalk{first, waited};
}

std::optional<DetectedWalk> WalkSearch::find_here(const TrackContext& context,
                                                  const SearchMoment& moment, double clearly) {
  const TrackerScene& scene = context.scene;
  const DetectorConfig& config = context.config.detector;
  if (places_.places.empty())
    places_ = place_grid(scene.cameras, context.body().subject.height, config);
  const SearchWindow window = view(context, moment);
  const WindowEnds ends = window_ends(window_.size());
  const std::vector<DetectedWalk> lines = lines_by_keypoints(window);
  const std::optional<DetectedWalk> walk =
      detect_walk({window_.size(), candidates(window, ends.early), candidates(window, ends.late),
                   lines, subjects_lines(window)},
                  window_score(window, context.body(), context.subject.figures), scene.dt,
                  camera_positions(scene), config, context.threads);
  const std::optional<Reach> reach = reach_in_frame(context, moment.last_seen, moment.first_frame);
  const bool believed = walk && (!reach || reach->contains(walk->position)) &&
                        walks_clearly(context, moment.first_frame, *walk, clearly);
  return believed ? walk : std::nullopt;
}

DetectedWalk WalkSearch::nearest_to(const TrackContext& context, const SearchMoment& moment,
                                    const DetectedWalk& given) {
  const auto nearest = [&] {
    const SearchWindow window = view(context, moment);
    return nearest_walk(
        given, window_.size(), window_score(window, context.body(), context.subject.figures),
        context.scene.dt, camera_positions(context.scene)[0], given_line(context, given));
  };
  const DetectedWalk walk = nearest();
  return compare_with_clothes(context, walk) ? nearest() : walk;
}

DetectedWalk WalkSearch::in_its_clothes(const TrackContext& context, const SearchMoment& moment,
                                        DetectedWalk walk) {
  const double score = mean_score(context, walk);
  if (!compare_with_clothes(context, walk)) return walk;
  walk.score -= score;
  walk.score += mean_score(context, walk);
  return find_here(context, moment, kAlreadyFound).value_or(walk);
}

bool WalkSearch::compare_with_clothes(const TrackContext& context, const DetectedWalk& walk) {
  const auto clothes = clothes_of(context, window_, walk);
  if (!clothes) return false;
  const auto compare = [&](std::deque<SceneEvidence>& frames, double first) {
    parallel_for(frames.size(), context.threads, [&](size_t i) {
      const double seconds = context.scene.dt * (first + double(i));
      compare_with(*clothes, context, moved(walk, std::max(0.0, seconds)).position, frames[i]);
    });
  };
  compare(waiting_, -double(waiting_.size()));  // in which the subject may stand there
  compare(window_, 0);
  compare(later_, double(window_.size()));
  clothed_ = true;
  forget_scores();
  return true;
}

const std::vector<Place>& WalkSearch::candidates(const SearchWindow& window, size_t index) {
  std::optional<std::vector<Place>>& found = candidates_[index];
  if (!found) {
    const TrackContext& context = window.context;
    found = places_in_frame(window, index, context.body(), context.subject.figures);
  }
  return *found;
}

bool WalkSearch::walks_clearly(const TrackContext& context, uint32_t first_frame,
                               const DetectedWalk& walk, double clearly) {
  if (!context.subject.standing || walk.over_standing >= clearly) return true;
  const double dt = context.scene.dt;
  return walks_on(first_frame, walk, dt * static_cast<double>(window_.size()), dt, slight_walks_);
}

SizedWalk WalkSearch::with_size(const TrackContext& context, const SearchMoment& moment,
                                const DetectedWalk& walk) const {
  return walk.given ? sized_up(view(context, moment), walk, context.body().subject.height,
                               given_line(context, *context.scene.initial))
                    : best_size(view(context, moment), walk);
}

std::optional<StandingStart> WalkSearch::standing_lead(const TrackContext& context,
                                                       const DetectedWalk& walk) const {
  if (!context.subject.standing || waiting_.empty()) return std::nullopt;
  const Pose figure = standing_pose(context.scene.model);
  const auto score = [&](size_t back, const Eigen::Vector2d& place,
                         double heading) -> std::optional<double> {
    if (back > waiting_.size()) return std::nullopt;
    return place_score(context.scene, waiting_[waiting_.size() - back], context.body(),
                       {&figure, 1}, place, heading);
  };
  std::optional<StandingStart> lead =
      standing_before(walk, score, context.scene.dt, context.config.detector);
  if (!lead) return std::nullopt;
  const double frames = double(window_.size() + lead->frames);
  lead->detected.score = (walk.score * double(window_.size()) + lead->score) / frames;
  const double walked = frames *
                        (score_with_lead(context, walk, lead->frames) - lead->detected.score) /
                        double(lead->frames);
  if (walked > kClearlyWalked * walk.score) return std::nullopt;
  return lead;
}

double WalkSearch::score_with_lead(const TrackContext& context, const DetectedWalk& walk,
                                   size_t lead) const {
  double sum = walk.score * double(window_.size());
  for (size_t back = 1; back <= lead; ++back)
    sum += score_at(context, waiting_[waiting_.size() - back],
                    moved(walk, -double(back) * context.scene.dt));
  return sum / double(window_.size() + lead);
}

void WalkSearch::reach_back(size_t frames) {
  for (size_t i = 0; i < frames; ++i) {
    window_.push_front(std::move(waiting_.back()));
    waiting_.pop_back();
    candidates_.emplace_front();
  }
}

void WalkSearch::let_go(size_t frames) {
  for (size_t i = 0; i < frames; ++i) {
    waiting_.push_back(std::move(window_.front()));
    window_.pop_front();
    candidates_.pop_front();
  }
}

void WalkSearch::step_back(size_t frames) {
  reach_back(frames);
  for (size_t i = 0; i < frames; ++i) {
    later_.push_front(std::move(window_.back()));
    window_.pop_back();
    candidates_.pop_back();
  }
}

void WalkSearch::step_on() {
  let_go(1);
  push(later_.front());
  later_.pop_front();
}

void WalkSearch::hide_occluders(const TrackContext& context, const FoundWalk& found) {
  const DetectedWalk begin = moved(found.walk, -context.scene.dt * double(found.lead));
  reach_back(found.lead);
  unhidden_.assign(window_.begin(), window_.end());
  walktrack::hide_occluders(context, begin, found.lead + found.walk.hidden_frames, window_);
  let_go(found.lead);
}

double WalkSearch::mean_score(const TrackContext& context, const DetectedWalk& walk) const {
  std::vector<double> scores(window_.size());
  parallel_for(scores.size(), context.threads, [&](size_t i) {
    scores[i] = score_at(context, window_[i], moved(walk, double(i) * context.scene.dt));
  });
  return std::accumulate(scores.begin(), scores.end(), 0.0) / double(scores.size());
}

void WalkSearch::weigh_at(const TrackContext& context, FoundWalk& found) {
  std::vector<DetectedWalk*> walks{&found.walk};
  if (found.first) walks.push_back(&*found.first);
  for (DetectedWalk* walk : walks) walk->score -= mean_score(context, *walk);
  for (const CameraEvidence& evidence : window_.front())
    search_weights_.push_back(evidence.pixel_weight);
  for (SceneEvidence& frame : waiting_) weigh_pixels(context, found.walk.position, frame);
  for (size_t i = 0; i < window_.size(); ++i) {
    const DetectedWalk then = moved(found.walk, double(i) * context.scene.dt);
    weigh_pixels(context, then.position, window_[i]);
  }
  for (DetectedWalk* walk : walks) walk->score += mean_score(context, *walk);
}

void WalkSearch::weigh_waiting(double share) {
  for (SceneEvidence& frame : waiting_)
    for (CameraEvidence& evidence : frame) evidence.pixel_weight *= share;
}

NearbyPeople WalkSearch::hide_others(const TrackContext& context, FoundWalk& found) {
  NearbyPeople people = alone(found.walk.position, found.walk.velocity);
  const auto expect_in = [&](size_t frame) {
    const DetectedWalk then = moved(found.walk, double(frame) * context.scene.dt);
    people.subject.mean << then.position, then.velocity;
  };
  std::vector<std::pair<size_t, SceneEvidence>> rest;
  for (size_t i = 0; i < window_.size(); ++i) {
    expect_in(i);
    follow_others(context, window_[i], people);
    if (auto without = without_others(context, people, window_[i]))
      rest.emplace_back(i, *std::move(without));
  }
  expect_in(window_.size());
  if (rest.empty()) return people;
  std::vector<DetectedWalk*> walks{&found.walk};
  if (found.first) walks.push_back(&*found.first);
  for (DetectedWalk* walk : walks) walk->score -= mean_score(context, *walk);
  for (auto& [i, without] : rest) std::swap(window_[i], without);
  for (DetectedWalk* walk : walks) walk->score += mean_score(context, *walk);
  with_others_ = std::move(rest);
  return people;
}

void WalkSearch::show_occluders() {
  if (unhidden_.empty()) return;
  const size_t lead = unhidden_.size() - window_.size();
  reach_back(lead);
  std::move(unhidden_.begin(), unhidden_.end(), window_.begin());
  unhidden_.clear();
  let_go(lead);
}

void WalkSearch::restore_evidence(const TrackContext& context) {
  show_occluders();
  for (auto& [i, frame] : std::exchange(with_others_, {})) window_[i] = std::move(frame);
  for (std::deque<SceneEvidence>* frames : {&waiting_, &window_}) {
    for (SceneEvidence& frame : *frames) {
      for (size_t c = 0; c < search_weights_.size(); ++c)
        frame[c].pixel_weight = search_weights_[c];
    }
  }
  search_weights_.clear();
  if (!std::exchange(clothed_, false)) return;
  for (std::deque<SceneEvidence>* frames : {&waiting_, &window_, &later_})
    parallel_for(frames->size(), context.threads,
                 [&](size_t i) { forget_clothes(context, (*frames)[i]); });
  forget_scores();
}

double WalkSearch::kept_seconds(bool may_stand) {
  return may_stand ? kStandingKept : kMostPatience;
}

bool WalkSearch::slide(const TrackContext& context) {
  let_go(1);
  const bool may_stand = context.subject.standing.has_value();
  const double kept = may_stand || half_hidden_ ? kept_seconds(may_stand) : 0;
  const bool needed = waiting_.size() <= passed_.value_or(0);
  if (needed || static_cast<double>(waiting_.size()) * context.scene.dt <= kept) return false;
  waiting_.pop_front();
  return true;
}

std::deque<SceneEvidence> WalkSearch::take() {
  waiting_.clear();
  candidates_.clear();
  half_hidden_.reset();
  passed_.reset();
  slight_walks_ = {};
  search_weights_.clear();
  with_others_.clear();
  unhidden_.clear();
  clothed_ = false;
  for (SceneEvidence& frame : window_) drop_colours(frame);
  return std::exchange(window_, {});
}

std::deque<SceneEvidence> WalkSearch::take_later() {
  for (SceneEvidence& frame : later_) drop_colours(frame);
  return std::exchange(later_, {});
}

}  // namespace tracker
}  // namespace walktrack
