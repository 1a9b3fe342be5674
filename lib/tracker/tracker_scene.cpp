#include "tracker/tracker_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tracker/motion/models/kneed_motion.h"

namespace walktrack {
inline namespace tracker {

namespace {

// The speeds of the templates, m/s. By hand.
constexpr double kSlowestTemplate = 0.5, kTemplateStep = 0.2;
constexpr int kPages = 9;

// The figure with the largest log-likelihood, of those with their roots above `position`.
template <typename F>
BestFigure best_of_figures(const Body& body, std::span<const Pose> figures,
                           const Eigen::Vector2d& position, double heading,
                           const F& log_likelihood) {
  BestFigure best;
  for (size_t i = 0; i < figures.size(); ++i) {
    Pose pose = figures[i];
    pose.root.head<2>() = position;
    pose.heading = heading;
    const double score = log_likelihood(PosedBody(body, pose));
    if (score > best.score) best = {score, i, pose};
  }
  return best;
}

}  // namespace

DetectorConfig detector_for(const TrackerScene& scene, DetectorConfig config) {
  config.least_score = scene.pictures ? config.least_score * scene.observation.outline_share
                                      : config.least_points_score;
  return config;
}

int frames_in(double seconds, double dt) {
  return std::max(2, static_cast<int>(std::lround(seconds / dt)));
}

PriorGait usual_gait(const BodyModel& model, const GaitPrior& prior, double speed, double heading) {
  const double leg = leg_length(model.body.lengths);
  const double unit_speed = std::sqrt(model.walker.parameters.gravity * leg);
  return gait_at(prior, in_plane(model, heading).parameters, speed,
                 leg * preferred_step_length(speed / unit_speed));
}

std::vector<Pose> walking_figures(const BodyModel& model, const GaitPrior& prior, double speed,
                                  double heading) {
  constexpr int kFigures = 6;  // by hand; half of them suffice for a first search
  const PriorGait gait = usual_gait(model, prior, speed, heading);
  std::vector<Pose> figures;
  for (int k = 0; k < kFigures; ++k)
    figures.push_back(pose_in_gait(model, gait, Side::kLeft, double(k) / kFigures));
  return figures;
}

PoseTemplates::PoseTemplates(const BodyModel& model, const GaitPrior& prior)
    : downhill_(model.downhill) {
  for (const double heading : table_headings(downhill_))
    for (int k = 0; k < kPages; ++k)
      figures_.push_back(
          walking_figures(model, prior, kSlowestTemplate + k * kTemplateStep, heading));
}

std::span<const Pose> PoseTemplates::at(double speed, double heading) const {
  const long page = std::lround((speed - kSlowestTemplate) / kTemplateStep);
  const auto of_speed = static_cast<size_t>(std::clamp(page, 0L, long{kPages - 1}));
  return figures_[table_heading(downhill_, heading) * kPages + of_speed];
}

BestFigure best_figure(const TrackerScene& scene, const SceneEvidence& evidence, const Body& body,
                       std::span<const Pose> figures, const Eigen::Vector2d& position,
                       double heading) {
  return best_of_figures(body, figures, position, heading, [&](const PosedBody& posed) {
    double sum = 0;
    for (size_t c = 0; c < evidence.size(); ++c)
      sum += still_log_likelihood(scene.observation, evidence[c], scene.cameras[c], posed);
    return sum;
  });
}

double place_score(const TrackerScene& scene, const SceneEvidence& evidence, const Body& body,
                   std::span<const Pose> figures, const Eigen::Vector2d& position, double heading) {
  return best_figure(scene, evidence, body, figures, position, heading).score;
}

double outline_score(const TrackerScene& scene, const SceneEvidence& evidence, const Body& body,
                     std::span<const Pose> figures, const Eigen::Vector2d& position,
                     double heading) {
  return best_of_figures(body, figures, position, heading,
                         [&](const PosedBody& posed) {
                           double sum = 0;
                           for (size_t c = 0; c < evidence.size(); ++c)
                             sum += SilhouetteTerm::log_likelihood(
                                 scene.observation, evidence[c], scene.cameras[c], posed, nullptr);
                           return sum;
                         })
      .score;
}

}  // namespace tracker
}  // namespace walktrack
