#include "tracker/figure/girth.h"

#include <algorithm>
#include <cmath>

namespace walktrack {
inline namespace tracker {

namespace {

// Outlines are explained best by figures that are so much wider than people, since pixels that are
// half covered count as theirs: fitted on ten people of known girth (tracker/reports/girth.md).
constexpr double kOutlinesWiden = 0.05;
// By how much a girth has to be larger than a usual one to be tried, and than one that is tried.
constexpr double kClearlyWider = 0.1, kStillWider = 0.03;
constexpr double kWidest = 1.5;     // by hand
constexpr double kGirthStep = 0.1;  // between the girths that are compared
// The least mean sine of the angle between heading and ray. By hand.
constexpr double kSeenFromSide = 0.87;

// The mean sine of the angle between the camera's ray and where the poses face; 0 without any.
double across_ray(const StartPoses& start) {
  const Eigen::Vector2d camera = camera_centre(start.scene.cameras[0]).head<2>();
  double sum = 0, tracked = 0;
  for (const FrameRecord& record : start.records) {
    if (!record.tracked) continue;
    const Pose& pose = record.estimate.pose;
    const Eigen::Vector2d ray = (pose.root.head<2>() - camera).stableNormalized();
    sum += std::abs(ray.x() * std::sin(pose.heading) - ray.y() * std::cos(pose.heading));
    ++tracked;
  }
  return tracked > 0 ? sum / tracked : 0;
}

// The girth that explains the outlines best, if it is that of the scene's body or larger;
// otherwise less than that.
double best_girth(const StartPoses& start) {
  const Body& body = start.scene.model.body;
  const double now = body.subject.girth;
  const double found =
      best_value({now, kGirthStep, now - kGirthStep, kWidest + kOutlinesWiden},
                 [&](double girth) { return outlines_score(start, with_girth(body, girth)); });
  return std::min(found - kOutlinesWiden, kWidest);
}

}  // namespace

Body with_girth(const Body& body, double girth) {
  Subject subject = body.subject;
  subject.girth = girth;
  return make_body(subject, body.groups);
}

std::optional<double> larger_girth(const StartPoses& start) {
  if (across_ray(start) < kSeenFromSide) return std::nullopt;
  const double now = start.scene.model.body.subject.girth, best = best_girth(start);
  const bool larger = best - now >= (now > 1 ? kStillWider : kClearlyWider);
  return larger ? std::optional(best) : std::nullopt;
}

}  // namespace tracker
}  // namespace walktrack
