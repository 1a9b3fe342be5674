// Finds a walking person before any tracking: the straight line over the ground along which a
// walking figure of the subject's size explains the foreground of a short stretch of video best.
//
// One frame of one camera hardly determines how far away a person is. A stretch of walking does,
// because one speed and one size must fit every frame. Candidate places in two frames propose
// lines, which are scored on all frames and refined.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "tracker/detect/detector_config.h"
#include "tracker/detect/figure_places.h"

namespace walktrack {
inline namespace tracker {

// Where the person was and how they moved, on the ground, metres and m/s.
// Along the viewing ray both are less certain.
struct DetectedWalk {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // at the window's first frame
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  Eigen::Vector2d ray = Eigen::Vector2d::UnitX();  // over the ground, away from the first camera
  double position_sd = 0, velocity_sd = 0;         // along the ray
  bool given = false;                              // by the scene, not found in a video
  bool standing = false;  // stands still, and will set off at that velocity
  // Nats for each frame: how much better the walk explains it than an empty scene.
  double score = 0;
  // Share of the score that a figure standing in the middle of the walk does not reach.
  double over_standing = 0;
  size_t hidden_frames = 0;  // the first ones of the window, in which the person is half hidden
};

// The same walk so many seconds later.
DetectedWalk moved(const DetectedWalk& walk, double seconds);

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

// The two frames of a window for which candidate places are needed: every line that is tried goes
// through a candidate of each.
struct WindowEnds {
  size_t early, late;
};
WindowEnds window_ends(size_t frames);

// What is known of a line before the images: the logarithm of its density, nats, up to a constant.
using LinePrior = std::function<double(const DetectedWalk&)>;

// Whether a line may be the subject's.
using LineCondition = std::function<bool(const DetectedWalk&)>;

struct WindowCandidates {
  size_t frames;  // of the window
  std::span<const Place> early, late;
  std::span<const DetectedWalk> lines{};  // further lines to try, which do not come from candidates
  LineCondition may_be{};                 // empty: any line may
};

// The walk through a window's frames, which are dt apart; nullopt if nobody walks there, or if the
// person is cut off by an edge or hidden in some of the frames. `camera_positions`: the places of
// the cameras, at least one. The distance is least certain along the rays of the first (any camera,
// if there are several).
std::optional<DetectedWalk> detect_walk(const WindowCandidates& candidates,
                                        const WindowScore& score, double dt,
                                        std::span<const Eigen::Vector2d> camera_positions,
                                        const DetectorConfig& config, int threads);

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
