#include "jobs/track/report/viewing_ray.h"

#include <cmath>

namespace walktrack {
inline namespace jobs {

namespace {

// More along the rays than across them.
constexpr double kMostlyAlong = 0.7;  // cosine

}  // namespace

double share_along_rays(const Motion& motion, const Eigen::Vector2d& camera) {
  constexpr double kLasts = 1;  // s; the body sways from step to step
  double along = 0, all = 0;
  size_t to = 0;
  for (size_t from = 0; from < motion.time.size(); ++from) {
    while (to < motion.time.size() && motion.time[to] - motion.time[from] < kLasts - 1e-6) ++to;
    if (to == motion.time.size()) break;
    const Eigen::Vector3d &first = motion.joints[from][Joint::kPelvis],
                          &last = motion.joints[to][Joint::kPelvis];
    if (!known(first) || !known(last)) continue;
    const Eigen::Vector2d way = (last - first).head<2>();
    const Eigen::Vector2d middle = 0.5 * (first + last).head<2>();
    along += std::abs(way.dot((middle - camera).normalized()));
    all += way.norm();
  }
  return all > 0 ? along / all : 0;
}

std::optional<std::string> viewing_ray_note(const Motion& motion, const Camera& camera) {
  if (share_along_rays(motion, camera_centre(camera).head<2>()) < kMostlyAlong) return std::nullopt;
  return "the subject walks towards the only camera or away from it: their distance may be wrong "
         "by 0.05 to 0.25 m, and speed and step lengths with it; a camera from the side shows them "
         "better";
}

}  // namespace jobs
}  // namespace walktrack
