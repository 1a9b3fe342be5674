#include "tracker/modes/loss.h"

#include <algorithm>
#include <array>

#include "core/anthropometry.h"
#include "core/conventions.h"

namespace walktrack {
inline namespace tracker {

namespace {

struct RigidFigure {
  Eigen::Vector2d place;
  double score;  // nats
};

RigidFigure figure_at(const TrackContext& context, const SceneEvidence& evidence,
                      const Eigen::Vector2d& place, double heading) {
  return {place, place_score(context.scene, evidence, context.body(),
                             context.subject.figures.at(anthropometry::kUsualSpeed, heading), place,
                             heading)};
}

// The best of several figures with the usual gait: at the place of the subject in several headings,
// and before one camera, which shows a figure nearer or farther in nearly the same place of the
// picture, at other distances.
RigidFigure best_figure(const TrackContext& context, const SceneEvidence& evidence,
                        const Pose& pose) {
  constexpr int kHeadings = 6;                            // 60 degrees apart; by hand
  constexpr std::array kDistances{0.7, 0.84, 1.2, 1.44};  // times that of the subject; by hand
  const Eigen::Vector2d place = pose.root.head<2>();
  RigidFigure best = figure_at(context, evidence, place, pose.heading);
  const auto try_at = [&](const Eigen::Vector2d& where, double heading) {
    const RigidFigure other = figure_at(context, evidence, where, heading);
    if (other.score > best.score) best = other;
  };
  for (int k = 1; k < kHeadings; ++k) try_at(place, pose.heading + 2 * kPi * k / kHeadings);
  if (context.scene.cameras.size() > 1) return best;
  const Eigen::Vector2d camera = camera_centre(context.scene.cameras[0]).head<2>();
  for (const double times : kDistances) try_at(camera + times * (place - camera), pose.heading);
  return best;
}

// Whether a figure lies on a detected person in any camera; nullopt if nobody is detected.
std::optional<bool> on_somebody(const TrackerScene& scene, const SceneEvidence& evidence,
                                const PosedBody& figure) {
  std::optional<bool> out;
  for (size_t c = 0; c < evidence.size(); ++c) {
    const auto found =
        KeypointTerm::on_somebody(scene.observation, evidence[c], scene.cameras[c], figure);
    if (found) out = out.value_or(false) || *found;
  }
  return out;
}

}  // namespace

bool is_lost(const TrackContext& context, const SceneEvidence& evidence, uint32_t frame,
             const FrameRecord& record, MonitorState& monitor) {
  if (record.filter.all_dead) return true;
  const TrackerConfig& config = context.config;
  const double dt = context.scene.dt;
  const Pose& pose = record.estimate.pose;
  const RigidFigure figure = best_figure(context, evidence, pose);
  if (is_fading(config.monitor, config.detector.least_score, dt, record.mean_log_likelihood,
                figure.score, monitor)) {
    if (monitor.frames_outscored > 0 && monitor.last_seen) {  // they are rather there
      monitor.last_seen->position = figure.place;
      monitor.last_seen->frame = frame + 1;
    }
    return true;
  }
  return is_off_people(config.monitor, dt,
                       on_somebody(context.scene, evidence, PosedBody(context.body(), pose)),
                       monitor);
}

}  // namespace tracker
}  // namespace walktrack
