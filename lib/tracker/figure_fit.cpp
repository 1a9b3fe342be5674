#include "tracker/figure_fit.h"

#include <algorithm>
#include <array>
#include <limits>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "observation/silhouette/overlap.h"
#include "observation/silhouette/silhouette_term.h"

namespace walktrack {
inline namespace tracker {

namespace {

// By hand.
constexpr std::array kAside{-0.4, -0.2, -0.1, -0.05, 0.05, 0.1, 0.2, 0.4};  // m
constexpr std::array kTurned{-30.0, -15.0, 15.0, 30.0};                     // degrees

PosedParts parts_of(const Body& body, const Pose& pose) {
  return pose_parts(body, forward_kinematics(body, pose));
}

double log_likelihood(const TrackerScene& scene, const SceneEvidence& evidence, const Pose& pose) {
  const PosedBody posed(scene.model.body, pose);
  double sum = 0;
  for (size_t c = 0; c < evidence.size(); ++c)
    sum += SilhouetteTerm::log_likelihood(scene.observation, evidence[c], scene.cameras[c], posed,
                                          nullptr);
  return sum;
}

// The same pose elsewhere: along the first camera's ray over the ground and across it, and turned.
std::vector<Pose> beside(const TrackerScene& scene, const Pose& pose) {
  const Eigen::Vector2d ray =
      (pose.root - camera_centre(scene.cameras[0])).head<2>().stableNormalized();
  std::vector<Pose> out;
  for (const Eigen::Vector2d& way : {ray, Eigen::Vector2d(-ray.y(), ray.x())}) {
    for (const double by : kAside) {
      out.push_back(pose);
      out.back().root.head<2>() += by * way;
    }
  }
  for (const double by : kTurned) {
    out.push_back(pose);
    out.back().heading += rad_from_deg(by);
  }
  return out;
}

double better_beside(const TrackerScene& scene, const SceneEvidence& evidence, const Pose& pose) {
  const double own = log_likelihood(scene, evidence, pose);
  double best = own;
  for (const Pose& other : beside(scene, pose))
    best = std::max(best, log_likelihood(scene, evidence, other));
  return best > 0 ? std::min(1.0, (best - own) / best) : 0;
}

}  // namespace

FigureFit figure_fit(const TrackerScene& scene, const SceneEvidence& evidence, const Pose& pose) {
  FigureFit out;
  const PosedParts parts = parts_of(scene.model.body, pose);
  for (size_t c = 0; c < evidence.size(); ++c) {
    const Overlap found = overlap(evidence[c].planes, project_parts(scene.cameras[c], parts));
    out.overlap.push_back(found.known() > 0 ? found.share()
                                            : std::numeric_limits<double>::quiet_NaN());
  }
  if (!evidence.empty()) out.better_beside = better_beside(scene, evidence, pose);
  return out;
}

}  // namespace tracker
}  // namespace walktrack
