// The straight line over the ground along which a walking figure explains a window of video best:
// scores of lines, climbs to their maxima, and how certain a maximum is.
//
// A climb shifts a line's two ends in a pattern that shrinks (Hooke & Jeeves, "Direct search
// solution of numerical and statistical problems", J. ACM 8, 1961). Metres, seconds, nats.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "tracker/detect/detected_walk.h"

namespace walktrack {
inline namespace tracker {

// A walking figure in one frame of a window, over a ground point.
struct FigureInFrame {
  double score;      // log-likelihood ratio, all cameras together, nats
  size_t index = 0;  // which of the figures that walk at the velocity it is
};

// The figure with the largest score of those that walk at that velocity, m/s, or of one of them
// that is stated by its index.
using WindowScore =
    std::function<FigureInFrame(size_t frame, const Eigen::Vector2d& place,
                                const Eigen::Vector2d& velocity, std::optional<size_t> index)>;

// What is known of a line before the images: the logarithm of its density, nats, up to a constant.
using LinePrior = std::function<double(const DetectedWalk&)>;

// Whether a line may be the subject's.
using LineCondition = std::function<bool(const DetectedWalk&)>;

// The frames in which a walk is searched.
struct LineWindow {
  const WindowScore& score;
  size_t frames;
  double dt;  // s
  int threads;
  LineCondition may_be{};  // of a line that is found; empty: any line may
  LinePrior known{};       // of the line that is searched; empty: nothing is known

  bool may_be_subject(const DetectedWalk& line) const;
};

// A line and its mean score for a frame, nats.
struct ScoredLine {
  DetectedWalk line;
  double score;
};

// A climb looks at every so many frames of a window.
size_t stride_of_climb(const LineWindow& window);

// The best figures' scores along a line, in every `stride`-th frame. `velocity`: at which they
// walk, m/s.
std::vector<double> scores_along(const LineWindow& window, const DetectedWalk& line,
                                 const Eigen::Vector2d& velocity, size_t stride);

// Log-posterior of a line by frame, in every `stride`-th frame.
double line_score(const LineWindow& window, const DetectedWalk& line, size_t stride = 1);

// A line with the score of a climb.
ScoredLine looked_at(const LineWindow& window, const DetectedWalk& line);

// The steps of a climb's shrinking pattern, m. In the coarse ones every figure is tried in every
// frame; in the fine ones only that which fitted best before them: it seldom changes
// (reports/search.md).
struct ClimbSteps {
  std::span<const double> sizes;
  bool every_figure;
};
inline constexpr double kCoarseSizes[] = {0.24, 0.12}, kFineSizes[] = {0.06, 0.03, 0.015};
inline constexpr ClimbSteps kCoarseSteps{kCoarseSizes, true}, kFineSteps{kFineSizes, false};

// Climbs from each of the lines. Of lines that climb to the same maximum one is left.
void climb(const LineWindow& window, const Eigen::Vector2d& camera_position,
           const ClimbSteps& steps, std::vector<ScoredLine>& lines);

// Measures the uncertainty of a line along the ray, from the curvature of its log-posterior.
void measure_spread(const Eigen::Vector2d& ray, const LineWindow& window, ScoredLine& walk);

// The line about `walk` that explains a window's frames best by this score, with its own score.
// `camera_position`: of the camera along whose rays the distance is least certain. `known`: what
// else is known of the line; empty: nothing.
DetectedWalk nearest_walk(const DetectedWalk& walk, size_t frames, const WindowScore& score,
                          double dt, const Eigen::Vector2d& camera_position,
                          const LinePrior& known = {});

// By how many nats the log-posterior of a line through `frames` frames, dt apart, grows if its
// score grows by one nat for each frame: the errors of frames that are close in time are
// correlated.
double independent_looks(size_t frames, double dt);

// The figures differ from the person: the errors of a detected line are larger by this factor than
// the curvature of the log-posterior says (measured on rendered walks, on which lines were wrong by
// 0.05 to 0.15 m and 0.1 to 0.3 m/s along the ray).
inline constexpr double kStrangeFigure = 2;

}  // namespace tracker
}  // namespace walktrack
