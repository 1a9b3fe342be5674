// Finding a walking person before any tracking: along which straight line over the ground does a
// walking figure of the subject's size best explain the foreground of a short stretch of video?
//
// One frame of one camera hardly tells how far away somebody is; a stretch of walking does, because
// one speed and one size must fit every frame. Candidates of two frames propose lines, which are
// scored on all frames and refined.
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
  double window = 1.2;       // s of video that a walk is read from: two steps
  double slowest = 0.35;     // m/s: who is slower is not walking
  double fastest = 3.0;      // m/s
  double least_share = 0.5;  // no moment's score below this share of the window's median
  double least_score = 6;    // nats, of the figure in any frame
  int candidates = 10;       // places of a frame that lines are laid through
  int grid_px = 8;           // spacing of the pixel grid at 640 px of image width
};

// Where the person was and how they moved, on the ground, metres and m/s.
// Along the viewing ray both are less certain.
struct DetectedWalk {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // at the window's first frame
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  Eigen::Vector2d ray = Eigen::Vector2d::UnitX();  // over the ground, away from the first camera
  double position_sd = 0, velocity_sd = 0;         // along the ray
  bool given = false;                              // by the scene, not found in a video
  bool standing = false;                           // still, and will set off at that velocity
  double score = 0;  // nats a frame: how much better than an empty scene the walk explains it
  double over_standing = 0;  // share of that which standing in the walk's middle does not explain
};

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
// image of every camera that has it in front.
std::vector<Eigen::Vector2d> standing_places(std::span<const Camera> cameras, double height,
                                             const DetectorConfig& config);

// The best of `places`, at least half a metre apart, best first.
std::vector<Place> find_figures(const PlaceScore& score, std::span<const Eigen::Vector2d> places,
                                const DetectorConfig& config, int threads);

// The two frames of a window that have to say where somebody may stand: through a candidate of each
// go the lines that are tried.
struct WindowEnds {
  size_t early, late;
};
WindowEnds window_ends(size_t frames);

struct WindowCandidates {
  size_t frames;  // of the window
  std::span<const Place> early, late;
  std::span<const DetectedWalk> lines{};  // further ones to try, from elsewhere
};

// The walk through a window's frames, dt apart; nullopt when nobody walks there, is cut
// off by an edge or hidden in part of the frames. `camera_position`: where the camera stands that
// sees the distance least (any, if several do).
std::optional<DetectedWalk> detect_walk(const WindowCandidates& candidates,
                                        const WindowScore& score, double dt,
                                        const Eigen::Vector2d& camera_position,
                                        const DetectorConfig& config, int threads);

// The line about `walk` that explains a window's frames best by this score, with its own score.
DetectedWalk nearest_walk(const DetectedWalk& walk, size_t frames, const WindowScore& score,
                          double dt, const Eigen::Vector2d& camera_position);

// How far the log-posterior of a line of `frames` frames, dt apart, grows with its score, nats for
// one nat a frame: frames close in time err together.
double independent_looks(size_t frames, double dt);

// The figures are not the person: errors of what is read off them are so much larger than the
// curvature of their log-posterior tells (measured on rendered walks, where lines were off by 0.05
// to 0.15 m and 0.1 to 0.3 m/s along the ray).
inline constexpr double kStrangeFigure = 2;

}  // namespace tracker
}  // namespace walktrack
