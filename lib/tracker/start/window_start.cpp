#include "tracker/start/window_start.h"

#include <span>
#include <utility>

#include "tracker/figure/girth.h"
#include "tracker/figure/trunk_length.h"
#include "tracker/start/keypoint_lead.h"
#include "tracker/start/trial.h"

namespace walktrack {
inline namespace tracker {

namespace {

// How often a figure is widened: what fits better with it shows the girth better. By hand.
constexpr int kMostWider = 4;
// How often the figure gets another trunk, for the same reason. By hand.
constexpr int kMostTrunks = 2;

// A start with the usual figure, which stands if the subject turns out not to be clearly wide. A
// moved deque allocates an empty one.
struct UsualStart {                // NOLINT(bugprone-exception-escape)
  std::optional<Stature> stature;  // if the height is estimated
  WindowStart start;
  TrackMode mode;     // after the window's frames
  WalkSearch search;  // after the start
  double log_likelihood;
  bool outlines_misled;  // in its trial
};

// The search of the trunk's length.
struct OtherTrunk {
  std::optional<double> wanted;  // by a trial, m
  int tried = 0;
  bool settled = false;
};

struct SearchedWindow {
  TrackedSubject& subject;
  WalkSearch& search;
  uint32_t first_frame;
  uint32_t& starts;
  TrackMode& mode;
  OtherTrunk trunk{};
  std::optional<double> girth{};      // that a trial asks for
  bool outlines_misled = false;       // in one of the trials
  int wider = 0;                      // how often the figure has been widened
  bool usual_girth = false;           // widening has shown that the subject is not clearly wide
  std::optional<UsualStart> usual{};  // while wider figures are tried
  NearbyPeople people{};              // after the window

  const Searching& searching() const { return std::get<Searching>(mode); }
  SearchMoment moment() const { return {first_frame, searching().last_seen}; }
  bool other_figure_wanted() const { return trunk.wanted || girth || outlines_misled; }
  StartPoses poses(std::span<const FrameRecord> records) const {
    return {subject.scene, search.window(), records};
  }
};

void set_height(SearchedWindow& window, double height, const std::optional<Stature>& estimate) {
  window.subject.set_height(height, estimate);
  window.search.forget_places();
}

// Whether a trial asks for a figure with another trunk; notes its length.
bool trunk_misleads(SearchedWindow& window, std::span<const FrameRecord> records) {
  OtherTrunk& trunk = window.trunk;
  if (trunk.settled || !window.subject.wants_trunk()) return false;
  if (trunk.tried < kMostTrunks) trunk.wanted = other_trunk(window.poses(records));
  trunk.settled = !trunk.wanted;
  return !trunk.settled;
}

// The girth that a trial asks for. The figure is widened step by step, and a usual one again if it
// does not get clearly wide.
std::optional<double> other_girth(SearchedWindow& window, std::span<const FrameRecord> records) {
  const TrackedSubject& subject = window.subject;
  if (!subject.wants_girth() || window.usual_girth) return std::nullopt;
  std::optional<double> larger;
  if (window.wider < kMostWider) larger = larger_girth(window.poses(records));
  if (larger || window.wider == 0 || subject.scene.model.body.subject.girth >= kClearlyWide)
    return larger;
  return 1;
}

bool outlines_mislead(const SearchedWindow& window, std::span<const FrameRecord> records) {
  const TrackerScene& scene = window.subject.scene;
  return may_lead(scene) && figure_is_too_thin(scene, window.search.window(), records);
}

// The start of a trial that begins with the first frame of the search's window, so many frames
// before the window that was searched.
WindowStart start_from(WalkSearch& search, uint32_t first_frame, size_t lead, Trial&& trial,
                       NearbyPeople people) {
  const size_t untracked = search.waiting();
  return {search.take(),
          first_frame - static_cast<uint32_t>(lead),
          std::move(trial.records),
          trial.legs_in_doubt,
          untracked,
          std::move(people)};
}

// Keeps what the usual figure finds while wider ones are tried; of two walks the better one.
void keep_usual(SearchedWindow& window, Trial&& trial, size_t lead) {
  const double score = trial.log_likelihood;
  if (window.wider > 0 || (window.usual && window.usual->log_likelihood >= score)) return;
  const bool misled = outlines_mislead(window, trial.records);
  TrackMode mode = std::move(trial.mode);
  WalkSearch search = window.search;
  WindowStart start = start_from(search, window.first_frame, lead, std::move(trial), window.people);
  window.usual = {
      window.subject.stature, std::move(start), std::move(mode), std::move(search), score, misled};
}

// Whether a trial's figure has another shape than the subject; notes what is wanted instead.
bool figure_misleads(SearchedWindow& window, std::span<const FrameRecord> records) {
  if (trunk_misleads(window, records)) return true;
  window.girth = other_girth(window, records);
  if (!window.girth && outlines_mislead(window, records)) window.outlines_misled = true;
  return window.other_figure_wanted();
}

// What the usual figure has found, unless its outlines mislead.
std::optional<WindowStart> usual_start(SearchedWindow& window) {
  std::optional<UsualStart> usual = std::exchange(window.usual, {});
  window.outlines_misled = usual && usual->outlines_misled;
  if (!usual || usual->outlines_misled) return std::nullopt;
  if (usual->stature) window.subject.set_height(usual->stature->height, usual->stature);
  window.mode = std::move(usual->mode);
  window.search = std::move(usual->search);
  return std::move(usual->start);
}

// Takes the trunk that a trial has asked for, or a usual one if nobody was found with another.
bool change_trunk(SearchedWindow& window) {
  OtherTrunk& trunk = window.trunk;
  const bool found_nobody = trunk.tried > 0 && !trunk.settled && !window.other_figure_wanted();
  if (!trunk.wanted && !found_nobody) return false;
  trunk.settled = found_nobody;
  ++trunk.tried;
  window.subject.set_trunk(std::exchange(trunk.wanted, {}));
  window.search.forget_scores();
  return true;
}

// Takes the figure that a trial has asked for, or a usual one if nobody was found with a wider one.
// Returns whether there is another one to search with, unless a start with it is known already.
bool change_figure(SearchedWindow& window, std::optional<WindowStart>& start) {
  if (change_trunk(window)) return true;
  const bool found_nobody = window.wider > 0 && !window.usual_girth;
  if (!window.other_figure_wanted() && found_nobody) window.girth = 1;
  const bool other = window.other_figure_wanted();
  if (const auto girth = std::exchange(window.girth, {})) {
    window.subject.set_girth(*girth);
    window.usual_girth = *girth == 1;
    ++window.wider;
    window.outlines_misled = false;
    if (window.usual_girth) start = usual_start(window);
  }
  if (std::exchange(window.outlines_misled, false)) {
    window.subject.let_keypoints_lead();
    window.usual.reset();
  }
  window.search.forget_scores();
  return other && !start;
}

// Tracks the window's frames from a walk on, and `lead` frames before them; nullopt if the trial
// fails or is dropped.
std::optional<Trial> tried(SearchedWindow& window, const DetectedWalk& walk, size_t lead) {
  WalkSearch& search = window.search;
  search.reach_back(lead);
  const uint32_t first = window.first_frame - static_cast<uint32_t>(lead);
  Trial trial = try_start(window.subject.context(), search.window(), first, walk, ++window.starts,
                          window.searching());
  const bool failed = is_searching(trial.mode);
  if (failed) window.mode = std::move(trial.mode);
  const bool dropped = !failed && figure_misleads(window, trial.records);
  std::optional<Trial> kept;
  if (dropped && window.girth)
    keep_usual(window, std::move(trial), lead);
  else if (!failed && !dropped)
    kept = std::move(trial);
  search.let_go(lead);
  return kept;
}

std::optional<WindowStart> start_of(SearchedWindow& window, std::optional<Trial> trial,
                                    size_t lead) {
  if (!trial) return std::nullopt;
  window.search.reach_back(lead);
  window.mode = std::move(trial->mode);
  return start_from(window.search, window.first_frame, lead, *std::move(trial),
                    std::move(window.people));
}

std::optional<WindowStart> start_at(SearchedWindow& window, const DetectedWalk& walk, size_t lead) {
  return start_of(window, tried(window, walk, lead), lead);
}

std::optional<Trial> tried_from_lead(SearchedWindow& window, const DetectedWalk& walk,
                                     size_t lead) {
  const TrackContext context = window.subject.context();
  DetectedWalk begin = moved(walk, -context.scene.dt * double(lead));
  begin.hidden_frames += lead;
  begin.score = window.search.score_with_lead(context, walk, lead);
  return tried(window, begin, lead);
}

// Starts with the walk, where it begins. Of a subject who was half hidden at first, two walks are
// known, and the one whose trial explains the frames better is taken; what was in front of the
// subject is no evidence.
std::optional<WindowStart> start_walking(SearchedWindow& window, const FoundWalk& found) {
  if (found.lead + found.walk.hidden_frames > 0)
    window.search.hide_occluders(window.subject.context(), found);
  std::optional<Trial> trial = tried_from_lead(window, found.walk, found.lead);
  if (found.first) {
    std::optional<Trial> other = tried_from_lead(window, *found.first, found.lead);
    if (!trial || (other && other->log_likelihood > trial->log_likelihood))
      trial = std::move(other);
  }
  return start_of(window, std::move(trial), found.lead);
}

// The frames of a search weigh pixels as if the subject were at a usual distance; the trial weighs
// them at the walk, as the frames after it. Several cameras keep the weights of the search,
// with which two telephones are tracked better (observation/reports/weights.md).
void weigh_at(SearchedWindow& window, FoundWalk& found) {
  if (window.subject.scene.cameras.size() == 1)
    window.search.weigh_at(window.subject.context(), found);
}

// What is evidence about somebody who walks there.
void prepare_evidence(SearchedWindow& window, FoundWalk& found) {
  weigh_at(window, found);
  if (window.subject.follows_others())
    window.people = window.search.hide_others(window.subject.context(), found);
}

// Starts where the subject stands before the walk; nullopt if they do not stand, or if the trial
// fails.
std::optional<WindowStart> start_standing(SearchedWindow& window, const DetectedWalk& walk) {
  const auto standing = window.search.standing_lead(window.subject.context(), walk);
  return standing ? start_at(window, standing->detected, standing->frames) : std::nullopt;
}

// The same, with less weight of still outlines first where keypoints lead before one camera.
std::optional<WindowStart> start_standing_still(SearchedWindow& window, const DetectedWalk& walk) {
  const TrackedSubject& subject = window.subject;
  if (subject.keypoints_lead() && subject.scene.cameras.size() == 1) {
    window.search.weigh_waiting(kStillOutlines);
    auto start = start_standing(window, walk);
    if (start || window.other_figure_wanted()) return start;
    window.search.weigh_waiting(1 / kStillOutlines);
  }
  return start_standing(window, walk);
}

// Starts where the subject stands before the walk, if they do; otherwise with the walk.
std::optional<WindowStart> start_sized(SearchedWindow& window, FoundWalk found) {
  prepare_evidence(window, found);
  if (found.lead == 0) {
    std::optional<WindowStart> start = start_standing_still(window, found.walk);
    if (start || window.other_figure_wanted()) return start;
  }
  return start_walking(window, found);
}

// The height is estimated along the walk that was found last, of a subject who is whole.
std::optional<WindowStart> start_unsized(SearchedWindow& window, const FoundWalk& found) {
  const double height_before = window.subject.scene.model.body.subject.height;
  const SizedWalk sized =
      window.search.with_size(window.subject.context(), window.moment(), found.walk);
  set_height(window, sized.stature.height, sized.stature);
  FoundWalk walk{sized.walk, found.lead};
  prepare_evidence(window, walk);
  std::optional<WindowStart> start = start_walking(window, walk);
  if (!start) set_height(window, height_before, std::nullopt);
  return start;
}

// The walk that the scene gives, or that is found.
std::optional<FoundWalk> walk_in(SearchedWindow& window) {
  const TrackContext context = window.subject.context();
  if (const auto& given = context.scene.initial)
    return FoundWalk{window.search.nearest_to(context, window.moment(), *given)};
  return window.search.find(context, window.moment());
}

std::optional<WindowStart> start_with_walk(SearchedWindow& window) {
  const std::optional<FoundWalk> walk = walk_in(window);
  if (!walk) return std::nullopt;
  std::optional<WindowStart> start =
      window.subject.wants_size() ? start_unsized(window, *walk) : start_sized(window, *walk);
  if (!start) window.search.restore_evidence(window.subject.context());
  return start;
}

}  // namespace

std::optional<WindowStart> start_in_window(TrackedSubject& subject, WalkSearch& search,
                                           uint32_t first_frame, uint32_t& starts,
                                           TrackMode& mode) {
  SearchedWindow window{subject, search, first_frame, starts, mode};
  std::optional<WindowStart> start;
  do start = start_with_walk(window);
  while (!start && change_figure(window, start));
  if (start) subject.shape_decided = true;
  if (!start && window.trunk.tried > 0) subject.set_trunk(std::nullopt);
  return start;
}

}  // namespace tracker
}  // namespace walktrack
