#include "tracker/detect/line_climb.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/anthropometry.h"
#include "core/parallel_for.h"

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::Vector2d;

// Frames that are used by a climb. By hand; sensitivity not measured.
constexpr size_t kScored = 12;

// The figures along a line, in every `stride`-th frame: the best ones, or those that are stated.
std::vector<FigureInFrame> figures_along(const LineWindow& window, const DetectedWalk& line,
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

// The prior of the speed, 1.25 +- .5 m/s. It matters along the viewing rays, for which images
// contain little evidence, so that a line might drift away without it.
double log_prior(const DetectedWalk& line) {
  const double strange = (line.velocity.norm() - anthropometry::kUsualSpeed) / 0.5;
  return -0.5 * strange * strange;
}

// Log-posterior of a line with these figures, by frame: every frame has the same weight, because
// all of them determine the place of a line, above all its distance.
double line_score(const LineWindow& window, const DetectedWalk& line,
                  std::span<const FigureInFrame> figures) {
  double sum = 0;
  for (const FigureInFrame& figure : figures) sum += figure.score;
  const double looks = independent_looks(window.frames, window.dt);
  const double known = window.known ? kStrangeFigure * kStrangeFigure * window.known(line) : 0;
  return sum / double(figures.size()) + (log_prior(line) + known) / looks;
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

Vector2d end_of(const DetectedWalk& line, double time) {
  return line.position + time * line.velocity;
}

DetectedWalk shifted(const DetectedWalk& line, const Shift& shift, double step, double time) {
  DetectedWalk out = line;
  out.position += step * shift.begin;
  out.velocity += step / time * (shift.end - shift.begin);
  return out;
}

using Figures = std::vector<FigureInFrame>;

// Climbs with the stated figures until no shift of a pattern of this step is an improvement any
// more; `stated`: as in figures_along.
ScoredLine climbed(ScoredLine walk, const LineWindow& window, const std::vector<Shift>& pattern,
                   double step, const Figures& stated) {
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
ScoredLine climbed_with_own_figures(ScoredLine walk, const LineWindow& window,
                                    const std::vector<Shift>& pattern, double step) {
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

// The best of each group of lines that are so close that they climb to the same maximum.
void drop_doubles(double apart, double time, std::vector<ScoredLine>& lines) {
  std::stable_sort(lines.begin(), lines.end(),
                   [](const ScoredLine& a, const ScoredLine& b) { return a.score > b.score; });
  std::vector<ScoredLine> kept;
  for (const ScoredLine& walk : lines) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const ScoredLine& other) {
      return (walk.line.position - other.line.position).norm() < apart &&
             (end_of(walk.line, time) - end_of(other.line, time)).norm() < apart;
    });
    if (!known) kept.push_back(walk);
  }
  lines = std::move(kept);
}

// Standard deviation of a shift of the line's ends, of which `shift` is one step, in its own size:
// from the curvature of the log-posterior over two steps.
double spread_of(const Shift& shift, const ScoredLine& walk, const LineWindow& window) {
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

}  // namespace

bool LineWindow::may_be_subject(const DetectedWalk& line) const { return !may_be || may_be(line); }

size_t stride_of_climb(const LineWindow& window) {
  return std::max<size_t>(1, window.frames / kScored);
}

std::vector<double> scores_along(const LineWindow& window, const DetectedWalk& line,
                                 const Vector2d& velocity, size_t stride) {
  std::vector<double> scores;
  for (const FigureInFrame& figure : figures_along(window, line, velocity, stride))
    scores.push_back(figure.score);
  return scores;
}

double line_score(const LineWindow& window, const DetectedWalk& line, size_t stride) {
  return line_score(window, line, figures_along(window, line, line.velocity, stride));
}

ScoredLine looked_at(const LineWindow& window, const DetectedWalk& line) {
  return {line, line_score(window, line, stride_of_climb(window))};
}

void climb(const LineWindow& window, const Vector2d& camera_position, const ClimbSteps& steps,
           std::vector<ScoredLine>& lines) {
  const double time = window.dt * double(window.frames - 1);
  for (const double step : steps.sizes) {
    // A single climb uses all threads; of several climbs each uses one.
    LineWindow own = window;
    if (lines.size() > 1) own.threads = 1;
    parallel_for(lines.size(), window.threads, [&](size_t i) {
      const DetectedWalk& line = lines[i].line;
      const std::vector<Shift> pattern =
          shifts({(line.position - camera_position).normalized(),
                  (end_of(line, time) - camera_position).normalized()});
      lines[i] = steps.every_figure ? climbed(lines[i], own, pattern, step, {})
                                    : climbed_with_own_figures(lines[i], own, pattern, step);
    });
    drop_doubles(2 * step, time, lines);
  }
}

void measure_spread(const Vector2d& ray, const LineWindow& window, ScoredLine& walk) {
  constexpr double kStep = 0.2;  // m; by hand
  const double time = window.dt * double(window.frames - 1);
  walk.line.ray = ray;
  walk.line.position_sd = kStep * spread_of({kStep * ray, kStep * ray}, walk, window);
  walk.line.velocity_sd = 2 * kStep / time * spread_of({-kStep * ray, kStep * ray}, walk, window);
}

DetectedWalk nearest_walk(const DetectedWalk& walk, size_t frames, const WindowScore& score,
                          double dt, const Vector2d& camera_position, const LinePrior& known) {
  const LineWindow window{score, frames, dt, 1, {}, known};
  std::vector<ScoredLine> walks{looked_at(window, walk)};
  climb(window, camera_position, kCoarseSteps, walks);
  climb(window, camera_position, kFineSteps, walks);
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
