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

#include "camera/camera.h"

namespace walktrack {
inline namespace tracker {

// By hand; sensitivity not measured.
struct DetectorConfig {
  double window = 1.2;       // s of video in which a walk is searched: two steps
  double slowest = 0.35;     // m/s, lowest speed of a walk
  double fastest = 3.0;      // m/s
  double least_share = 0.5;  // lowest score of a frame, as a share of the window's median
  double least_score = 6;    // nats, lowest score of the figure in any frame
  // The same if there are only keypoints: nine points of a network at the places where a figure has
  // them contribute 5.6 nats.
  double least_points_score = 1;
  int candidates = 10;  // places of a frame through which lines are tried
  int grid_px = 8;      // spacing of the pixel grid at 640 px of image width
};

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

struct Place {
  Eigen::Vector2d position;
  double score;  // nats
};

// Log-likelihood ratio of the walking figure over a ground point, all cameras together, nats.
using PlaceScore = std::function<double(const Eigen::Vector2d&)>;
// The same in one frame of a window, the figure walking at a velocity, m/s.
using WindowScore = std::function<double(size_t frame, const Eigen::Vector2d& place,
                                         const Eigen::Vector2d& velocity)>;

// The heading that shows a figure over `position` side on to the camera.
double side_on_heading(const Camera& camera, const Eigen::Vector2d& position);

// Ground points under the pixel grid of `cameras[0]` at which the figure lies wholly inside the
// image of every camera that has the point in front of it.
std::vector<Eigen::Vector2d> standing_places(std::span<const Camera> cameras, double height,
                                             const DetectorConfig& config);

// The best of `places`, at least half a metre apart, best first.
std::vector<Place> find_figures(const PlaceScore& score, std::span<const Eigen::Vector2d> places,
                                const DetectorConfig& config, int threads);

// The two frames of a window for which candidate places are needed: every line that is tried goes
// through a candidate of each.
struct WindowEnds {
  size_t early, late;
};
WindowEnds window_ends(size_t frames);

struct WindowCandidates {
  size_t frames;  // of the window
  std::span<const Place> early, late;
  std::span<const DetectedWalk> lines{};  // further lines to try, which do not come from candidates
};

// The walk through a window's frames, which are dt apart; nullopt if nobody walks there, or if the
// person is cut off by an edge or hidden in some of the frames. `camera_position`: the place of the
// camera along whose rays the distance is least certain (any camera, if there are several).
std::optional<DetectedWalk> detect_walk(const WindowCandidates& candidates,
                                        const WindowScore& score, double dt,
                                        const Eigen::Vector2d& camera_position,
                                        const DetectorConfig& config, int threads);

// The line about `walk` that explains a window's frames best by this score, with its own score.
DetectedWalk nearest_walk(const DetectedWalk& walk, size_t frames, const WindowScore& score,
                          double dt, const Eigen::Vector2d& camera_position);

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
