#include "tracker/modes/loss.h"

#include <algorithm>
#include <limits>

#include "core/anthropometry.h"
#include "core/conventions.h"

namespace walktrack {
inline namespace tracker {

namespace {

// The score, in nats, of a figure with the usual gait at the place of the subject, for the best of
// several headings.
double figure_score(const TrackContext& context, const SceneEvidence& evidence, const Pose& pose) {
  constexpr int kHeadings = 6;  // 60 degrees apart; by hand
  double best = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < kHeadings; ++k) {
    const double heading = pose.heading + 2 * kPi * k / kHeadings;
    const std::span<const Pose> figures =
        context.subject.figures.at(anthropometry::kUsualSpeed, heading);
    best = std::max(best, place_score(context.scene, evidence, context.body(), figures,
                                      pose.root.head<2>(), heading));
  }
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

bool is_lost(const TrackContext& context, const SceneEvidence& evidence, const FrameRecord& record,
             MonitorState& monitor) {
  if (record.filter.all_dead) return true;
  const TrackerConfig& config = context.config;
  const double dt = context.scene.dt;
  const Pose& pose = record.estimate.pose;
  if (is_fading(config.monitor, config.detector.least_score, dt, record.mean_log_likelihood,
                figure_score(context, evidence, pose), monitor))
    return true;
  return is_off_people(config.monitor, dt,
                       on_somebody(context.scene, evidence, PosedBody(context.body(), pose)),
                       monitor);
}

}  // namespace tracker
}  // namespace walktrack
