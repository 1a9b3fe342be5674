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

// Arms swing by these angles of the shoulder, with bent elbows: a figure without arms leaves their
// pixels out. By hand.
constexpr std::array kSwings{-25.0, 0.0, 25.0};  // degrees
constexpr double kBent = 15;

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
  return (best - own) / static_cast<double>(evidence.size());
}

bool is_arm(Segment segment) {
  using enum Segment;
  return segment == kLeftUpperArm || segment == kRightUpperArm || segment == kLeftForearm ||
         segment == kRightForearm;
}

// Where the arms of somebody in this pose may be, if the figure has none.
std::vector<PosedParts> unmodelled_arms(const Body& body, Pose pose) {
  std::vector<PosedParts> out;
  if (body.groups.arms) return out;
  Body arms = make_body(body.subject, {.head = false, .arms = true});
  std::erase_if(arms.parts, [](const Part& part) { return !is_arm(part.segment); });
  for (const double swing : kSwings) {
    pose.arms.fill({rad_from_deg(swing), 0, rad_from_deg(kBent)});
    out.push_back(parts_of(arms, pose));
  }
  return out;
}

}  // namespace

FigureFit figure_fit(const TrackerScene& scene, const SceneEvidence& evidence, const Pose& pose) {
  FigureFit out;
  const PosedParts parts = parts_of(scene.model.body, pose);
  const std::vector<PosedParts> arms = unmodelled_arms(scene.model.body, pose);
  for (size_t c = 0; c < evidence.size(); ++c) {
    std::vector<CapsuleList> unmodelled;
    for (const PosedParts& each : arms) unmodelled.push_back(project_parts(scene.cameras[c], each));
    const Overlap found =
        overlap(evidence[c].planes, project_parts(scene.cameras[c], parts), unmodelled);
    out.seen.push_back(found.seen);
    out.overlap.push_back(found.known() > 0 ? found.share()
                                            : std::numeric_limits<double>::quiet_NaN());
  }
  if (!evidence.empty()) out.better_beside = better_beside(scene, evidence, pose);
  return out;
}

}  // namespace tracker
}  // namespace walktrack
