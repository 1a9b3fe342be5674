#include "tracker/detect/search_window.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "camera/inspection.h"
#include "core/anthropometry.h"
#include "core/parallel_for.h"
#include "tracker/detect/detector.h"
#include "tracker/detect/keypoint_lines.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Heights within so many deviations of what is known are tried. By hand.
constexpr double kLikely = 3;

// Somebody who walks straight on passes a place within this distance, m, and within so much more
// for each second between the window and that moment. By hand.
constexpr double kPasses = 0.5, kPassesLater = 0.3;

// Standard deviation of a velocity that a scene states, m/s: .2 of 1.2 m/s are 10 degrees. By hand.
constexpr double kGivenVelocity = 0.2;

// The walk in the window that is found with figures of another body.
std::optional<DetectedWalk> look_for_walk(const SearchWindow& window, const BodyModel& model) {
  const TrackContext& context = window.context;
  const PoseTemplates figures(model, context.prior);
  const WindowEnds ends = window_ends(window.frames.size());
  const std::vector<Place> early = places_in_frame(window, ends.early, model.body, figures),
                           late = places_in_frame(window, ends.late, model.body, figures);
  return detect_walk({window.frames.size(), early, late, {}, subjects_lines(window)},
                     window_score(window, model.body, figures), context.scene.dt,
                     camera_positions(context.scene), context.config.detector, context.threads);
}

// Metres for each pixel of the video whose camera shows a person there largest.
double least_metres_per_px(const TrackerScene& scene, const Eigen::Vector2d& place) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t c = 0; c < scene.cameras.size(); ++c) {
    const double shrink = scene.shrink.empty() ? 1 : scene.shrink[c];
    const double each = metres_per_px(scene.cameras[c], place) / shrink;
    if (each > 0) least = std::min(least, each);
  }
  return least;
}

}  // namespace

std::optional<Reach> reach_in_frame(const TrackContext& context,
                                    const std::optional<LastSeen>& last_seen, uint32_t frame) {
  const auto in_picture = [&](const Eigen::Vector2d& place) {
    return in_any_picture(context.scene.cameras, hips_at(place, context.body().subject.height));
  };
  return reach_of(context.config.monitor, last_seen, frame, context.scene.dt, in_picture);
}

WindowScore window_score(const SearchWindow& window, const Body& body,
                         const PoseTemplates& figures) {
  return [&](size_t frame, const Eigen::Vector2d& place, const Eigen::Vector2d& velocity,
             std::optional<size_t> index) -> FigureInFrame {
    const double heading = std::atan2(velocity.y(), velocity.x());
    std::span<const Pose> tried = figures.at(velocity.norm(), heading);
    if (index) tried = tried.subspan(*index, 1);
    const BestFigure best =
        best_figure(window.context.scene, window.frames[frame], body, tried, place, heading);
    return {best.score, index.value_or(best.index)};
  };
}

std::vector<Place> places_in_frame(const SearchWindow& window, size_t index, const Body& body,
                                   const PoseTemplates& templates) {
  const TrackContext& context = window.context;
  const std::optional<Reach> reach =
      reach_in_frame(context, window.last_seen, window.first_frame + static_cast<uint32_t>(index));
  const auto score = [&](const Eigen::Vector2d& place) {
    if (reach && !reach->contains(place)) return 0.0;
    // Half of the figures and half a step suffice for a first search.
    const double heading = side_on_heading(context.scene.cameras[0], place);
    const std::span<const Pose> figures = templates.at(anthropometry::kUsualSpeed, heading);
    return place_score(context.scene, window.frames[index], body, figures.first(figures.size() / 2),
                       place, heading);
  };
  return find_figures(score, window.places, context.config.detector, context.threads);
}

std::vector<DetectedWalk> lines_by_keypoints(const SearchWindow& window) {
  constexpr double kLeastShare = 0.5;  // of the window in which the person was seen; by hand
  const TrackerScene& scene = window.context.scene;
  const DetectorConfig& config = window.context.config.detector;
  std::vector<DetectedWalk> out;
  for (size_t c = 0; c < scene.cameras.size(); ++c) {
    std::vector<const KeypointEvidence*> frames;
    for (const SceneEvidence& frame : window.frames) frames.push_back(&frame[c].keypoints);
    for (const KeypointLine& line :
         keypoint_lines(frames, scene.cameras[c], window.context.body().subject.height, scene.dt,
                        kLeastShare * config.window)) {
      const double speed = line.velocity.norm();
      if (speed >= config.slowest && speed <= config.fastest)
        out.push_back({.position = line.position, .velocity = line.velocity});
    }
  }
  return out;
}

LineCondition subjects_lines(const SearchWindow& window) {
  const TrackerScene& scene = window.context.scene;
  if (!scene.near) return {};
  const double when = scene.near->frame - window.first_frame,
               last = static_cast<double>(window.frames.size()) - 1;
  const double outside = scene.dt * std::max({0.0, -when, when - last});
  return [place = scene.near->position, seconds = scene.dt * when,
          reach = kPasses + kPassesLater * outside](const DetectedWalk& walk) {
    return (moved(walk, seconds).position - place).norm() < reach;
  };
}

std::vector<Eigen::Vector2d> camera_positions(const TrackerScene& scene) {
  std::vector<Eigen::Vector2d> out;
  for (const Camera& camera : scene.cameras) out.push_back(camera_centre(camera).head<2>());
  return out;
}

LinePrior given_line(const TrackContext& context, const DetectedWalk& given) {
  return [given, place_sd = context.subject.motion.given_position_sd](const DetectedWalk& line) {
    return -0.5 *
           ((line.position - given.position).squaredNorm() / (place_sd * place_sd) +
            (line.velocity - given.velocity).squaredNorm() / (kGivenVelocity * kGivenVelocity));
  };
}

SizedWalk sized_up(const SearchWindow& window, const DetectedWalk& walk, double height,
                   const LinePrior& known) {
  const TrackContext& context = window.context;
  const auto score = [&](double tried) -> WindowScore {
    const BodyModel model = with_height(context.scene.model, tried);
    return [&window, body = model.body, figures = PoseTemplates(model, context.prior)](
               size_t frame, const Eigen::Vector2d& place, const Eigen::Vector2d& velocity,
               std::optional<size_t> index) {
      return window_score(window, body, figures)(frame, place, velocity, index);
    };
  };
  return size_up(
      walk, height, context.scene.stature, score,
      {window.frames.size(), context.scene.dt, camera_centre(context.scene.cameras[0]).head<2>(),
       least_metres_per_px(context.scene, walk.position), known});
}

SizedWalk best_size(const SearchWindow& window, const DetectedWalk& found) {
  const TrackContext& context = window.context;
  const std::optional<Stature>& known = context.scene.stature;
  std::vector<SizedWalk> sizes{{{context.body().subject.height, 0}, found}};
  for (const double height : {1.3, 1.5, 1.6, 1.9}) {
    if (known && std::abs(height - known->height) > kLikely * known->sd) continue;
    const auto other = look_for_walk(window, with_height(context.scene.model, height));
    if (other) sizes.push_back({{height, 0}, *other});
  }
  parallel_for(sizes.size(), context.threads, [&](size_t i) {
    sizes[i] = sized_up(window, sizes[i].walk, sizes[i].stature.height);
  });
  return *std::max_element(sizes.begin(), sizes.end(), [](const SizedWalk& a, const SizedWalk& b) {
    return a.walk.score < b.walk.score;
  });
}

}  // namespace tracker
}  // namespace walktrack
