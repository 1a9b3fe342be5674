#include "jobs/track/out_of_picture.h"

#include <algorithm>

namespace walktrack {
inline namespace jobs {

namespace {

bool in_any_picture(std::span<const Camera> cameras, const Eigen::Vector3d& point) {
  return std::ranges::any_of(cameras, [&](const Camera& camera) {
    const auto pixel = project(camera, point);
    return pixel && inside_image(camera, *pixel);
  });
}

}  // namespace

bool out_of_picture(std::span<const Camera> cameras, const FrameEstimate& figure, bool before) {
  if (before) return !in_any_picture(cameras, figure.joints[Joint::kPelvis]);
  for (size_t j = 0; j < figure.joint_count; ++j)
    if (in_any_picture(cameras, figure.joints.at[j])) return false;
  return true;
}

}  // namespace jobs
}  // namespace walktrack
