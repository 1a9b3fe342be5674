#include "tracker/start/girth.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "body/kinematics.h"
#include "observation/silhouette/silhouette_term.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Outlines are explained best by figures that are so much wider than people, since pixels that are
// half covered count as theirs: fitted on ten people of known girth (tracker/reports/girth.md).
constexpr double kOutlinesWiden = 0.05;
// By how much a girth has to be larger than a usual one to be tried, and than one that is tried.
constexpr double kWorthTrying = 0.1, kStillWider = 0.03;
constexpr double kWidest = 1.5;     // by hand
constexpr double kGirthStep = 0.1;  // between the girths that are compared; a parabola is put
                                    // through the best one and its neighbours
// The least mean sine of the angle between heading and ray. By hand.
constexpr double kSeenFromSide = 0.87;

// The mean sine of the angle between the camera's ray and where the poses face; 0 without any.
double across_ray(const TrackerScene& scene, std::span<const FrameRecord> records) {
  const Eigen::Vector2d camera = camera_centre(scene.cameras[0]).head<2>();
  double sum = 0, tracked = 0;
  for (const FrameRecord& record : records) {
    if (!record.tracked) continue;
    const Pose& pose = record.estimate.pose;
    const Eigen::Vector2d ray = (pose.root.head<2>() - camera).stableNormalized();
    sum += std::abs(ray.x() * std::sin(pose.heading) - ray.y() * std::cos(pose.heading));
    ++tracked;
  }
  return tracked > 0 ? sum / tracked : 0;
}

// Where a parabola through three values a step apart has its top, in steps from the middle one,
// which is the largest.
double top_of_parabola(double below, double middle, double above) {
  const double bent = below - 2 * middle + above;
  return bent < 0 ? 0.5 * (below - above) / bent : 0;
}

// Of the outlines, nats, if the poses are those of a body.
double outlines_score(const TrackerScene& scene, const Body& body,
                      const std::deque<SceneEvidence>& window,
                      std::span<const FrameRecord> records) {
  double sum = 0;
  for (size_t i = 0; i < std::min(records.size(), window.size()); ++i) {
    if (!records[i].tracked) continue;
    const PosedBody posed(body, records[i].estimate.pose);
    sum += SilhouetteTerm::log_likelihood(scene.observation, window[i][0], scene.cameras[0], posed,
                                          nullptr);
  }
  return sum;
}

// The girth that explains the outlines best, if it is that of the scene's body or larger;
// otherwise less than that.
double best_girth(const TrackerScene& scene, const std::deque<SceneEvidence>& window,
                  std::span<const FrameRecord> records) {
  const auto score = [&](double girth) {
    return outlines_score(scene, with_girth(scene.model.body, girth), window, records);
  };
  double girth = scene.model.body.subject.girth, below = score(girth - kGirthStep),
         best = score(girth), above = score(girth + kGirthStep);
  if (below > best) return girth - kGirthStep;
  while (above > best && girth < kWidest + kOutlinesWiden) {
    girth += kGirthStep;
    below = std::exchange(best, above);
    above = score(girth + kGirthStep);
  }
  const double found = girth + kGirthStep * top_of_parabola(below, best, above);
  return std::min(found - kOutlinesWiden, kWidest);
}

}  // namespace

Body with_girth(const Body& body, double girth) {
  Subject subject = body.subject;
  subject.girth = girth;
  return make_body(subject, body.groups);
}

std::optional<double> larger_girth(const TrackerScene& scene,
                                   const std::deque<SceneEvidence>& window,
                                   std::span<const FrameRecord> records) {
  if (across_ray(scene, records) < kSeenFromSide) return std::nullopt;
  const double now = scene.model.body.subject.girth, best = best_girth(scene, window, records);
  const bool larger = best - now >= (now > 1 ? kStillWider : kWorthTrying);
  return larger ? std::optional(best) : std::nullopt;
}

}  // namespace tracker
}  // namespace walktrack
