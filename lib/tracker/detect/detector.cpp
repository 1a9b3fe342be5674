#include "tracker/detect/detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/median.h"
#include "core/parallel_for.h"

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::Vector2d;

double mean_of_worst_third(std::vector<double> scores) {
  const size_t third = (scores.size() + 2) / 3;
  std::nth_element(scores.begin(), scores.begin() + long(third - 1), scores.end());
  return std::accumulate(scores.begin(), scores.begin() + long(third), 0.0) / double(third);
}

// A figure that stands in the middle of a line.
DetectedWalk halt(const LineWindow& window, const DetectedWalk& line) {
  const double half = 0.5 * window.dt * double(window.frames - 1);
  return {line.position + half * line.velocity, Vector2d::Zero(), line.ray, 0, 0};
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

double share_over_standing(const LineWindow& window, const DetectedWalk& line) {
  const double walking = mean(scores_along(window, line, line.velocity, 1));
  return 1 - mean(scores_along(window, halt(window, line), line.velocity, 1)) / walking;
}

// Whether a figure that stands in the middle of the line explains the frames that a climb looks at
// `times` as well as the walk does: such a line is one along the ray of somebody who stands.
bool stands(const LineWindow& window, const DetectedWalk& line, double times) {
  const size_t stride = stride_of_climb(window);
  return mean(scores_along(window, halt(window, line), line.velocity, stride)) >=
         times * mean(scores_along(window, line, line.velocity, stride));
}

// Whether the line explains its worst frames better than a figure standing in its middle explains
// the worst frames of that: a person who stands there, or two things that are always there, are not
// a walk.
bool moves(const LineWindow& window, const DetectedWalk& line) {
  const DetectedWalk still = halt(window, line);
  const Vector2d& pace = line.velocity;
  return mean_of_worst_third(scores_along(window, line, pace, 1)) >
         std::max(0.0, mean_of_worst_third(scores_along(window, still, pace, 1)));
}

// Lines through a candidate of an early and one of a late frame, at a walking speed.
std::vector<ScoredLine> proposed_walks(const WindowCandidates& window, double dt,
                                       const DetectorConfig& config) {
  const auto [early, late] = window_ends(window.frames);
  const double time = dt * double(late - early);
  std::vector<ScoredLine> walks;
  for (const Place& from : window.early) {
    for (const Place& to : window.late) {
      const Vector2d velocity = (to.position - from.position) / time;
      if (velocity.norm() < config.slowest || velocity.norm() > config.fastest) continue;
      walks.push_back({{from.position - dt * double(early) * velocity, velocity}, 0});
    }
  }
  return walks;
}

// The least mean of `span` consecutive numbers.
double least_mean(std::span<const double> values, size_t span) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i + span <= values.size(); ++i) {
    const auto part = values.subspan(i, span);
    least = std::min(least, std::accumulate(part.begin(), part.end(), 0.0) / double(span));
  }
  return least;
}

// Number of frames, `dt` s apart, of a moment. Over shorter times the score may be low, because a
// person's long step has poses that no figure resembles.
size_t frames_of_moment(double dt) {
  constexpr double kMoment = 0.15;  // s; by hand, a tenth of a stride
  return static_cast<size_t>(std::max(1L, std::lround(kMoment / dt)));
}

// The lowest score of a line over a moment, nats, using every `stride`-th frame.
double worst_moment(std::span<const double> scores, double dt, size_t stride) {
  return least_mean(scores, std::min(frames_of_moment(dt * double(stride)), scores.size()));
}

// Number of frames at the beginning in which a person comes out from behind something. Walks of
// people who are visible all the time begin with .84 to 1.5 of the median of their window, those of
// the real side view, where a tree hides half of the woman, with .44 to .51.
size_t hidden_at_first(std::span<const double> scores, double dt) {
  constexpr double kHidden = 0.7, kWhole = 0.85;  // shares of the median; by hand
  const size_t moment = frames_of_moment(dt);
  const double median = median_of({scores.begin(), scores.end()});
  const auto share = [&](size_t at) {
    return least_mean(scores.subspan(at, moment), moment) / median;
  };
  if (scores.size() < 2 * moment || share(0) >= kHidden) return 0;
  size_t at = 1;
  while (at + moment < scores.size() && share(at) < kWhole) ++at;
  return at;
}

// The person is not hidden or cut off: the score does not stay far below its median.
bool seen_throughout(const ScoredLine& walk, const LineWindow& window,
                     const DetectorConfig& config) {
  const std::vector<double> scores = scores_along(window, walk.line, walk.line.velocity, 1);
  const double least = worst_moment(scores, window.dt, 1);
  return least >= config.least_score && least >= config.least_share * median_of(scores);
}

// Half-way through its climb a line that fits no better than a figure standing in its middle
// belongs to a person who stands, and one that fits worse than an empty scene over a moment to a
// person who is hidden then: the last steps of the climb do not change this.
bool worth_refining(const ScoredLine& walk, const LineWindow& window) {
  if (stands(window, walk.line, 1)) return false;
  const size_t stride = stride_of_climb(window);
  return worst_moment(scores_along(window, walk.line, walk.line.velocity, stride), window.dt,
                      stride) >= 0;
}

bool walks_on(const ScoredLine& walk, const LineWindow& window, const DetectorConfig& config) {
  const double speed = walk.line.velocity.norm();
  return speed >= config.slowest && speed <= config.fastest && window.may_be_subject(walk.line) &&
         moves(window, walk.line) && seen_throughout(walk, window, config);
}

// The line that is `share` as far from a camera, of whose image it explains the same part.
DetectedWalk scaled(const DetectedWalk& line, const Vector2d& camera_position, double share) {
  DetectedWalk out = line;
  out.position = camera_position + share * (line.position - camera_position);
  out.velocity = share * line.velocity;
  return out;
}

// The best of the lines at other distances from the cameras, climbed to its maximum; nullopt if
// none of them is better. A climb stops before a camera that looks at the first: behind it, it sees
// nobody, and just before it, it sees a giant.
std::optional<ScoredLine> better_at_other_distance(const ScoredLine& walk, const LineWindow& window,
                                                   std::span<const Vector2d> camera_positions) {
  constexpr double kFarthest = 3, kApart = 1.2;  // times the distance; by hand
  std::vector<ScoredLine> others;
  for (const Vector2d& camera : camera_positions)
    for (double times = kApart; times < kFarthest; times *= kApart)
      for (const double share : {times, 1 / times})
        others.push_back(looked_at(window, scaled(walk.line, camera, share)));
  std::erase_if(others,
                [&](const ScoredLine& other) { return !window.may_be_subject(other.line); });
  if (others.empty()) return std::nullopt;
  std::vector<ScoredLine> best{*std::ranges::max_element(others, {}, &ScoredLine::score)};
  if (best[0].score <= walk.score) return std::nullopt;
  climb(window, camera_positions[0], kCoarseSteps, best);
  climb(window, camera_positions[0], kFineSteps, best);
  return best[0];
}

}  // namespace

WindowEnds window_ends(size_t frames) {
  const size_t early = frames / 6;
  return {early, frames - 1 - early};
}

std::optional<DetectedWalk> detect_walk(const WindowCandidates& candidates,
                                        const WindowScore& score, double dt,
                                        std::span<const Vector2d> camera_positions,
                                        const DetectorConfig& config, int threads) {
  const Vector2d& camera_position = camera_positions[0];
  constexpr size_t kRefined = 4, kStride = 3;  // lines, frames; by hand
  // A climb may turn a line that fits a little worse than standing into a walk: with 1 the walk
  // before two telephones was found in another window (reports/search.md).
  constexpr double kTimesAsWell = 1.05;
  const LineWindow window{score, candidates.frames, dt, threads, candidates.may_be};
  std::vector<ScoredLine> walks = proposed_walks(candidates, dt, config);
  for (const DetectedWalk& line : candidates.lines) walks.push_back({line, 0});
  std::erase_if(walks, [&](const ScoredLine& walk) { return !window.may_be_subject(walk.line); });
  if (walks.empty()) return std::nullopt;
  parallel_for(walks.size(), threads, [&](size_t i) {
    walks[i].score = line_score({score, candidates.frames, dt, 1}, walks[i].line, kStride);
  });
  std::erase_if(walks, [&](const ScoredLine& walk) { return walk.score < config.least_score; });
  std::stable_sort(walks.begin(), walks.end(),
                   [](const ScoredLine& a, const ScoredLine& b) { return a.score > b.score; });
  walks.resize(std::min(walks.size(), kRefined));
  std::erase_if(walks,
                [&](const ScoredLine& walk) { return stands(window, walk.line, kTimesAsWell); });
  for (ScoredLine& walk : walks) walk = looked_at(window, walk.line);
  climb(window, camera_position, kCoarseSteps, walks);
  std::erase_if(walks, [&](const ScoredLine& walk) { return !worth_refining(walk, window); });
  climb(window, camera_position, kFineSteps, walks);
  std::erase_if(walks, [&](const ScoredLine& walk) { return !walks_on(walk, window, config); });
  if (walks.empty()) return std::nullopt;
  ScoredLine& best =
      *std::max_element(walks.begin(), walks.end(),
                        [](const ScoredLine& a, const ScoredLine& b) { return a.score < b.score; });
  if (const auto better = better_at_other_distance(best, window, camera_positions)) {
    if (!walks_on(*better, window, config)) return std::nullopt;
    best = *better;
  }
  best.score = line_score(window, best.line);
  measure_spread((best.line.position - camera_position).normalized(), window, best);
  best.line.score = best.score;
  best.line.over_standing = share_over_standing(window, best.line);
  best.line.hidden_frames =
      hidden_at_first(scores_along(window, best.line, best.line.velocity, 1), dt);
  return best.line;
}

}  // namespace tracker
}  // namespace walktrack
