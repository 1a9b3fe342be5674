#include "tracker/detect/detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/anthropometry.h"
#include "core/median.h"
#include "core/parallel_for.h"

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::Vector2d;

// Frames that are used by a climb. By hand; sensitivity not measured.
constexpr size_t kScored = 12;

// A straight walk and its mean score for a frame, nats.
struct Walk {
  DetectedWalk line;
  double score;
};

// The frames in which a walk is searched.
struct Window {
  const WindowScore& score;
  size_t frames;
  double dt;  // s
  int threads;
  LineCondition may_be{};  // of a line that is found
  LinePrior known{};       // of the line that is searched

  bool may_be_subject(const DetectedWalk& line) const { return !may_be || may_be(line); }
};

size_t stride_of_climb(const Window& window) {
  return std::max<size_t>(1, window.frames / kScored);
}

// The figures along a line, in every `stride`-th frame: the best ones, or those that are stated.
std::vector<FigureInFrame> figures_along(const Window& window, const DetectedWalk& line,
                                         const Vector2d& velocity, size_t stride,
                                         std::span<const FigureInFrame> stated = {}) {
  std::vector<FigureInFrame> figures((window.frames + stride - 1) / stride);
  parallel_for(figures.size(), window.threads, [&](size_t i) {
    const double time = window.dt * double(i * stride);
    const auto index = stated.empty() ? std::nullopt : std::optional(stated[i].index);
    figures[i] = window.score(i * stride, line.position + time * line.velocity, velocity, index);
  });
  return figures;
}

// The best figures' scores along a line, in every `stride`-th frame.
std::vector<double> scores_along(const Window& window, const DetectedWalk& line,
                                 const Vector2d& velocity, size_t stride) {
  std::vector<double> scores;
  for (const FigureInFrame& figure : figures_along(window, line, velocity, stride))
    scores.push_back(figure.score);
  return scores;
}

// The prior of the speed, 1.25 +- .5 m/s. It matters along the viewing rays, for which images
// contain little evidence, so that a line might drift away without it.
double log_prior(const DetectedWalk& line) {
  const double strange = (line.velocity.norm() - anthropometry::kUsualSpeed) / 0.5;
  return -0.5 * strange * strange;
}

// Log-posterior of a line with these figures, by frame: every frame has the same weight, because
// all of them determine the place of a line, above all its distance.
double line_score(const Window& window, const DetectedWalk& line,
                  std::span<const FigureInFrame> figures) {
  double sum = 0;
  for (const FigureInFrame& figure : figures) sum += figure.score;
  const double looks = independent_looks(window.frames, window.dt);
  const double known = window.known ? kStrangeFigure * kStrangeFigure * window.known(line) : 0;
  return sum / double(figures.size()) + (log_prior(line) + known) / looks;
}

double line_score(const Window& window, const DetectedWalk& line, size_t stride = 1) {
  return line_score(window, line, figures_along(window, line, line.velocity, stride));
}

double mean_of_worst_third(std::vector<double> scores) {
  const size_t third = (scores.size() + 2) / 3;
  std::nth_element(scores.begin(), scores.begin() + long(third - 1), scores.end());
  return std::accumulate(scores.begin(), scores.begin() + long(third), 0.0) / double(third);
}

// A figure that stands in the middle of a line.
DetectedWalk halt(const Window& window, const DetectedWalk& line) {
  const double half = 0.5 * window.dt * double(window.frames - 1);
  return {line.position + half * line.velocity, Vector2d::Zero(), line.ray, 0, 0};
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

double share_over_standing(const Window& window, const DetectedWalk& line) {
  const double walking = mean(scores_along(window, line, line.velocity, 1));
  return 1 - mean(scores_along(window, halt(window, line), line.velocity, 1)) / walking;
}

// Whether a figure that stands in the middle of the line explains the frames that a climb looks at
// `times` as well as the walk does: such a line is one along the ray of somebody who stands.
bool stands(const Window& window, const DetectedWalk& line, double times) {
  const size_t stride = stride_of_climb(window);
  return mean(scores_along(window, halt(window, line), line.velocity, stride)) >=
         times * mean(scores_along(window, line, line.velocity, stride));
}

// Whether the line explains its worst frames better than a figure standing in its middle explains
// the worst frames of that: a person who stands there, or two things that are always there, are not
// a walk.
bool moves(const Window& window, const DetectedWalk& line) {
  const DetectedWalk still = halt(window, line);
  const Vector2d& pace = line.velocity;
  return mean_of_worst_third(scores_along(window, line, pace, 1)) >
         std::max(0.0, mean_of_worst_third(scores_along(window, still, pace, 1)));
}

// Lines through a candidate of an early and one of a late frame, at a walking speed.
std::vector<Walk> proposed_walks(const WindowCandidates& window, double dt,
                                 const DetectorConfig& config) {
  const auto [early, late] = window_ends(window.frames);
  const double time = dt * double(late - early);
  std::vector<Walk> walks;
  for (const Place& from : window.early) {
    for (const Place& to : window.late) {
      const Vector2d velocity = (to.position - from.position) / time;
      if (velocity.norm() < config.slowest || velocity.norm() > config.fastest) continue;
      walks.push_back({{from.position - dt * double(early) * velocity, velocity}, 0});
    }
  }
  return walks;
}

// The pattern of a climb: shifts of the line's two ends, metres. The score is a ridge along the
// viewing rays, so the pattern lies along and across each end's own. Four shifts are followed by
// their opposites.
struct Shift {
  Vector2d begin, end;
};
constexpr size_t opposite(size_t shift) { return shift ^ 4; }

std::vector<Shift> shifts(const Shift& rays) {
  const Shift across{{-rays.begin.y(), rays.begin.x()}, {-rays.end.y(), rays.end.x()}};
  const Vector2d none = Vector2d::Zero();
  std::vector<Shift> out;
  for (const Shift& axes : {rays, across}) {
    for (const double sign : {1.0, -1.0}) {
      const Vector2d begin = sign * axes.begin, end = sign * axes.end;
      out.insert(out.end(), {{begin, end}, {begin, none}, {none, end}, {begin, -end}});
    }
  }
  return out;
}

// The steps of a climb's shrinking pattern, m. In the coarse ones every figure is tried in every
// frame; in the fine ones only that which fitted best before them: it seldom changes
// (reports/search.md).
struct Steps {
  std::span<const double> sizes;
  bool every_figure;
};
constexpr double kCoarse[] = {0.24, 0.12}, kFine[] = {0.06, 0.03, 0.015};
constexpr Steps kCoarseSteps{kCoarse, true}, kFineSteps{kFine, false};

Vector2d end_of(const DetectedWalk& line, double time) {
  return line.position + time * line.velocity;
}

// A walk whose score is that of a climb, which looks at some of the frames.
Walk looked_at(const Window& window, const DetectedWalk& line) {
  return {line, line_score(window, line, stride_of_climb(window))};
}

DetectedWalk shifted(const DetectedWalk& line, const Shift& shift, double step, double time) {
  return {.position = line.position + step * shift.begin,
          .velocity = line.velocity + step / time * (shift.end - shift.begin),
          .ray = line.ray,
          .given = line.given};
}

using Figures = std::vector<FigureInFrame>;

// Climbs with the stated figures until no shift of a pattern of this step is an improvement any
// more; `stated`: as in figures_along.
Walk climbed(Walk walk, const Window& window, const std::vector<Shift>& pattern, double step,
             const Figures& stated) {
  const double time = window.dt * double(window.frames - 1);
  std::optional<size_t> back;  // the shift that leads to where the climb came from
  for (size_t i = 0, failed = 0; failed < pattern.size(); i = (i + 1) % pattern.size()) {
    ++failed;
    if (i == back) continue;
    const DetectedWalk line = shifted(walk.line, pattern[i], step, time);
    const double score = line_score(
        window, line, figures_along(window, line, line.velocity, stride_of_climb(window), stated));
    if (score <= walk.score) continue;
    walk = {line, score};
    back = opposite(i);
    failed = 0;
  }
  return walk;
}

bool same_figures(const Figures& a, const Figures& b) {
  return std::ranges::equal(a, b, {}, &FigureInFrame::index, &FigureInFrame::index);
}

// The same with the figures that fit best where a climb ends, until these stay the same.
Walk climbed_with_own_figures(Walk walk, const Window& window, const std::vector<Shift>& pattern,
                              double step) {
  const auto own = [&] {
    return figures_along(window, walk.line, walk.line.velocity, stride_of_climb(window));
  };
  Figures figures = own(), before;
  do {
    walk = climbed(walk, window, pattern, step, figures);
    before = std::exchange(figures, own());
    walk.score = line_score(window, walk.line, figures);
  } while (!same_figures(figures, before));
  return walk;
}

// The best of each group of walks that are so close that they climb to the same maximum.
void drop_doubles(double apart, double time, std::vector<Walk>& walks) {
  std::stable_sort(walks.begin(), walks.end(),
                   [](const Walk& a, const Walk& b) { return a.score > b.score; });
  std::vector<Walk> kept;
  for (const Walk& walk : walks) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Walk& other) {
      return (walk.line.position - other.line.position).norm() < apart &&
             (end_of(walk.line, time) - end_of(other.line, time)).norm() < apart;
    });
    if (!known) kept.push_back(walk);
  }
  walks = std::move(kept);
}

// Climbs from each of them.
void refine(const Window& window, const Vector2d& camera_position, const Steps& steps,
            std::vector<Walk>& walks) {
  const double time = window.dt * double(window.frames - 1);
  for (const double step : steps.sizes) {
    // A single climb uses all threads; of several climbs each uses one.
    Window own = window;
    if (walks.size() > 1) own.threads = 1;
    parallel_for(walks.size(), window.threads, [&](size_t i) {
      const DetectedWalk& line = walks[i].line;
      const std::vector<Shift> pattern =
          shifts({(line.position - camera_position).normalized(),
                  (end_of(line, time) - camera_position).normalized()});
      walks[i] = steps.every_figure ? climbed(walks[i], own, pattern, step, {})
                                    : climbed_with_own_figures(walks[i], own, pattern, step);
    });
    drop_doubles(2 * step, time, walks);
  }
}

// Standard deviation of a shift of the line's ends, of which `shift` is one step, in its own size:
// from the curvature of the log-posterior over two steps.
double spread_of(const Shift& shift, const Walk& walk, const Window& window) {
  const double time = window.dt * double(window.frames - 1);
  double bent = -2 * walk.score;
  for (const double sign : {1.0, -1.0}) {
    DetectedWalk line = walk.line;
    line.position += sign * shift.begin;
    line.velocity += sign / time * (shift.end - shift.begin);
    bent += line_score(window, line);
  }
  constexpr double kFlat = 0.05;  // nats: no less curved than this; by hand
  return kStrangeFigure /
         std::sqrt(independent_looks(window.frames - 1, window.dt) * std::max(kFlat, -bent));
}

// The uncertainty of a walk along the ray.
void measure_spread(const Vector2d& ray, const Window& window, Walk& walk) {
  constexpr double kStep = 0.2;  // m; by hand
  const double time = window.dt * double(window.frames - 1);
  walk.line.ray = ray;
  walk.line.position_sd = kStep * spread_of({kStep * ray, kStep * ray}, walk, window);
  walk.line.velocity_sd = 2 * kStep / time * spread_of({-kStep * ray, kStep * ray}, walk, window);
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
bool seen_throughout(const Walk& walk, const Window& window, const DetectorConfig& config) {
  const std::vector<double> scores = scores_along(window, walk.line, walk.line.velocity, 1);
  const double least = worst_moment(scores, window.dt, 1);
  return least >= config.least_score && least >= config.least_share * median_of(scores);
}

// Half-way through its climb a line that fits no better than a figure standing in its middle
// belongs to a person who stands, and one that fits worse than an empty scene over a moment to a
// person who is hidden then: the last steps of the climb do not change this.
bool worth_refining(const Walk& walk, const Window& window) {
  if (stands(window, walk.line, 1)) return false;
  const size_t stride = stride_of_climb(window);
  return worst_moment(scores_along(window, walk.line, walk.line.velocity, stride), window.dt,
                      stride) >= 0;
}

bool walks_on(const Walk& walk, const Window& window, const DetectorConfig& config) {
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
std::optional<Walk> better_at_other_distance(const Walk& walk, const Window& window,
                                             std::span<const Vector2d> camera_positions) {
  constexpr double kFarthest = 3, kApart = 1.2;  // times the distance; by hand
  std::vector<Walk> others;
  for (const Vector2d& camera : camera_positions)
    for (double times = kApart; times < kFarthest; times *= kApart)
      for (const double share : {times, 1 / times})
        others.push_back(looked_at(window, scaled(walk.line, camera, share)));
  std::erase_if(others, [&](const Walk& other) { return !window.may_be_subject(other.line); });
  if (others.empty()) return std::nullopt;
  std::vector<Walk> best{*std::ranges::max_element(others, {}, &Walk::score)};
  if (best[0].score <= walk.score) return std::nullopt;
  refine(window, camera_positions[0], kCoarseSteps, best);
  refine(window, camera_positions[0], kFineSteps, best);
  return best[0];
}

}  // namespace

DetectedWalk moved(const DetectedWalk& walk, double seconds) {
  DetectedWalk out = walk;
  out.position += seconds * walk.velocity;
  out.position_sd = std::hypot(walk.position_sd, seconds * walk.velocity_sd);
  return out;
}

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
  const Window window{score, candidates.frames, dt, threads, candidates.may_be};
  std::vector<Walk> walks = proposed_walks(candidates, dt, config);
  for (const DetectedWalk& line : candidates.lines) walks.push_back({line, 0});
  std::erase_if(walks, [&](const Walk& walk) { return !window.may_be_subject(walk.line); });
  if (walks.empty()) return std::nullopt;
  parallel_for(walks.size(), threads, [&](size_t i) {
    walks[i].score = line_score({score, candidates.frames, dt, 1}, walks[i].line, kStride);
  });
  std::erase_if(walks, [&](const Walk& walk) { return walk.score < config.least_score; });
  std::stable_sort(walks.begin(), walks.end(),
                   [](const Walk& a, const Walk& b) { return a.score > b.score; });
  walks.resize(std::min(walks.size(), kRefined));
  std::erase_if(walks, [&](const Walk& walk) { return stands(window, walk.line, kTimesAsWell); });
  for (Walk& walk : walks) walk = looked_at(window, walk.line);
  refine(window, camera_position, kCoarseSteps, walks);
  std::erase_if(walks, [&](const Walk& walk) { return !worth_refining(walk, window); });
  refine(window, camera_position, kFineSteps, walks);
  std::erase_if(walks, [&](const Walk& walk) { return !walks_on(walk, window, config); });
  if (walks.empty()) return std::nullopt;
  Walk& best = *std::max_element(walks.begin(), walks.end(),
                                 [](const Walk& a, const Walk& b) { return a.score < b.score; });
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

DetectedWalk nearest_walk(const DetectedWalk& walk, size_t frames, const WindowScore& score,
                          double dt, const Vector2d& camera_position, const LinePrior& known) {
  const Window window{score, frames, dt, 1, {}, known};
  std::vector<Walk> walks{looked_at(window, walk)};
  refine(window, camera_position, kCoarseSteps, walks);
  refine(window, camera_position, kFineSteps, walks);
  DetectedWalk found = walks[0].line;
  found.score = line_score(window, found);
  return found;
}

double independent_looks(size_t frames, double dt) {
  constexpr double kIndependent_s = 0.15;  // by hand; sensitivity not measured
  return std::max(1.0, dt * double(frames) / kIndependent_s);
}

}  // namespace tracker
}  // namespace walktrack
